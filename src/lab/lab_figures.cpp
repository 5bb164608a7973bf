#include "kestrel/lab/lab_figures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "kestrel/io/svg_bars.hpp"
#include "kestrel/io/svg_plot.hpp"
#include "kestrel/io/svg_space.hpp"

#include "figure_parts.hpp"

namespace kestrel {
namespace {

using figures::DrawnRun;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// What lies far outside of the image has no place, lest it make the rest small.
double near_image(double px, int size_px) {
  return px > -0.6 * size_px && px < 1.6 * size_px ? px : kNone;
}

void add_trajectories(Plot& plot, const DrawnRun& drawn, const LabScene& scene) {
  for (int i = 0;; ++i) {
    std::vector<double> u = drawn.trace.column(fmt::format("u{}_px", i));
    std::vector<double> v = drawn.trace.column(fmt::format("v{}_px", i));
    if (u.empty() || v.empty()) return;
    if (plot.marks.size() < scene.goal_px.size())
      plot.marks.push_back({"start", u.front(), v.front(), Shape::Cross, 6});
    for (double& px : u) px = near_image(px, scene.width_px);
    for (double& px : v) px = near_image(px, scene.height_px);
    plot.series.push_back({i == 0 ? drawn.run->law : "", std::move(u), std::move(v), drawn.law,
                           figures::stroke_of(drawn.law)});
  }
}

std::string image_figure(const std::vector<DrawnRun>& runs, const LabScene& scene) {
  Plot plot;
  plot.title = "Points in the image";
  plot.x_label = "u (px)";
  plot.y_label = "v (px)";
  plot.axes = Plot::Axes::EqualDown;
  plot.height_px = 560;
  for (const DrawnRun& drawn : runs) add_trajectories(plot, drawn, scene);
  for (const Pixel& goal : scene.goal_px)
    plot.marks.push_back({"goal", goal.u, goal.v, Shape::Circle, 6});
  const double w = scene.width_px;
  const double h = scene.height_px;
  plot.series.push_back({"image border", {0, w, w, 0, 0}, {0, 0, h, h, 0}, -1, Stroke::Faint});
  return svg_plot(plot);
}

std::string time_figure(const std::vector<DrawnRun>& runs, const std::string& column,
                        const std::string& title, const std::string& label) {
  Plot plot;
  plot.title = title;
  plot.x_label = "time (s)";
  plot.y_label = label;
  plot.names = Plot::Names::LineEnds;
  plot.y_spacing = column == "error_norm" ? Spacing::Logarithmic : Spacing::Linear;
  plot.height_px = 400;
  const double until_s = figures::horizon_s(runs);
  for (const DrawnRun& drawn : runs) {
    Series line = figures::over_time(drawn, column, until_s);
    for (double& y : line.y)
      if (column == "error_norm") y = std::max(y, 1e-8);  // what is smaller is rounding
    plot.series.push_back(std::move(line));
  }
  return svg_plot(plot);
}

std::string path_figure(const std::vector<DrawnRun>& runs, const LabScene& scene) {
  const bool flies = scene.kind == RunKind::Helicopter;
  SpacePlot plot;
  plot.title = "Path of the camera in space";
  if (flies) plot.view = {{0, 0, -1}, {-1, -0.8, -0.7}};
  for (const DrawnRun& drawn : runs) {
    const auto x = drawn.trace.column(flies ? "camera_north_m" : "tx_m");
    const auto y = drawn.trace.column(flies ? "camera_east_m" : "ty_m");
    const auto z = drawn.trace.column(flies ? "camera_down_m" : "tz_m");
    SpaceLine line{drawn.run->law, {}, drawn.law, figures::stroke_of(drawn.law)};
    for (std::size_t i = 0; i < std::min({x.size(), y.size(), z.size()}); ++i)
      line.points_m.emplace_back(x[i], y[i], z[i]);
    if (drawn.run->end != RunEnd::Converged) line.fit = SpaceLine::Fit::Cut;
    plot.lines.push_back(std::move(line));
  }
  if (!scene.points_m.empty()) {
    SpaceLine target{"target", scene.points_m, 6};
    target.points_m.push_back(scene.points_m.front());
    plot.lines.push_back(std::move(target));
  }
  plot.frames = {scene.start, scene.goal};
  return svg_space(plot);
}

/// A bar for each run; what did not converge says how it ended.
std::string bar_figure(const std::vector<DrawnRun>& runs, const std::string& key,
                       const std::string& title, const std::string& label) {
  BarChart chart;
  chart.title = title;
  chart.value_label = label;
  for (const DrawnRun& drawn : runs) {
    const auto value = figure(*drawn.run, key);
    Bar bar{drawn.run->law, value.value_or(kNone)};
    bar.colour = drawn.law;
    if (drawn.run->end != RunEnd::Converged) bar.note = end_words(*drawn.run), bar.value = kNone;
    chart.bars.push_back(std::move(bar));
  }
  return svg_bars(chart);
}

}  // namespace

std::vector<std::string> scenario_figures(const LabReport& report, const std::string& scenario,
                                          const std::string& modifier) {
  const std::vector<DrawnRun> runs = figures::drawn_runs(report, scenario, modifier);
  if (runs.empty()) return {};
  const LabScene* known = scene_named(report, scenario);
  LabScene scene = known ? *known : LabScene{};
  if (!known) scene.kind = runs.front().run->kind;
  const bool has_trace = std::any_of(runs.begin(), runs.end(),
                                     [](const DrawnRun& d) { return !d.trace.rows.empty(); });
  std::vector<std::string> out;
  if (has_trace) {
    out = {image_figure(runs, scene), time_figure(runs, "error_norm", "Error |s − s*|", "|e|"),
           path_figure(runs, scene)};
  }
  if (scene.kind == RunKind::Helicopter) {
    if (has_trace) out.push_back(time_figure(runs, "position_error_m", "Position error", "m"));
    out.push_back(bar_figure(runs, "final_position_m", "Final position error", "m"));
  } else {
    out.push_back(bar_figure(runs, "retreat_m", "Retreat", "m"));
    out.push_back(bar_figure(runs, "approach_m", "Approach", "m"));
  }
  return out;
}

}  // namespace kestrel
