#include "row_plot.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "kestrel/io/module.hpp"

#include "display.hpp"
#include "plot_module.hpp"

namespace kestrel::app {
namespace {

constexpr double kBetween_s = 0.2;
constexpr double kShown_s = 60;

const PlotModule& plot_module() {
  require_display();
  return module_functions<PlotModule>("plot");
}

/// The curves of each graph, in the order of values_of.
std::vector<PlotGraph> graphs(bool servoes) {
  const std::vector<std::string> corners{"x0", "y0", "x1", "y1", "x2", "y2", "x3", "y3"};
  if (!servoes) {
    return {{"corners", "px", corners},
            {"deviation of a corner", "px", {"largest"}},
            {"confidence", "", {"confidence"}},
            {"keypoints", "", {"matches", "inliers"}}};
  }
  return {{"feature errors", "", corners},
          {"camera twist", "m/s, rad/s", {"vx", "vy", "vz", "wx", "wy", "wz"}},
          {"command", "m/s, rad/s", {"forward", "right", "down", "yaw rate"}},
          {"condition number", "", {"condition"}}};
}

using Values = std::vector<double>;

std::vector<Values> servo_values(const LogRow& row) {
  std::vector<Values> all(4);
  if (row.servo) {
    all[0].assign(row.servo->error.begin(), row.servo->error.end());
    const auto& twist = row.servo->twist.vector();
    all[1].assign(twist.begin(), twist.end());
    all[3] = {row.servo->condition};
  }
  const auto& sent = row.decision->sent.vector();
  all[2].assign(sent.begin(), sent.end());
  return all;
}

std::vector<Values> track_values(const LogRow& row) {
  std::vector<Values> all(4);
  if (row.corners) {
    for (const Pixel& corner : *row.corners) {
      all[0].push_back(corner.u);
      all[0].push_back(corner.v);
    }
  }
  if (row.noise) {
    double most_px2 = 0;
    for (const auto& noise : *row.noise) most_px2 = std::max({most_px2, noise[0], noise[2]});
    all[1] = {std::sqrt(most_px2)};
  }
  all[2] = {row.confidence};
  all[3] = {double(row.matches), double(row.inliers)};
  return all;
}

}  // namespace

RowPlot::RowPlot(cv::Size pictures) : module_(plot_module()), pictures_(pictures) {}

RowPlot::~RowPlot() {
  if (plots_ != nullptr) module_.close(plots_);
}

void RowPlot::open(const LogRow& row) {
  servoes_ = row.decision.has_value();
  constexpr int kFrame_px = 40;  // about what a window manager puts around a window
  constexpr int kWide_px = 900;  // with the curves beside them too wide for most screens
  PlotWindow window{"Curves of the run", 0, 0, 480};
  if (pictures_.width > kWide_px) {
    window.top_px = pictures_.height + kFrame_px;
  } else {
    window.left_px = pictures_.width + kFrame_px;
  }
  plots_ = module_.open(window, graphs(servoes_));
}

void RowPlot::draw(const LogRow& row) {
  if (plots_ == nullptr) open(row);
  const double now_s = row.stamp_s;
  if (began_s_ && now_s >= drawn_s_ && now_s - drawn_s_ < kBetween_s) return;
  if (!began_s_ || now_s < drawn_s_ || now_s - *began_s_ > kShown_s) {
    if (began_s_) module_.begin(*plots_, "");
    began_s_ = now_s;
    module_.span(*plots_, now_s, now_s + kShown_s);
  }
  drawn_s_ = now_s;
  if (servoes_ && !row.decision) return;
  const std::vector<Values> graphs = servoes_ ? servo_values(row) : track_values(row);
  for (std::size_t graph = 0; graph < graphs.size(); ++graph) {
    for (std::size_t curve = 0; curve < graphs[graph].size(); ++curve) {
      const double value = graphs[graph][curve];
      if (std::isfinite(value)) module_.add(*plots_, int(graph), int(curve), now_s, value);
    }
  }
}

}  // namespace kestrel::app
