#include "live_plot.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "kestrel/io/module.hpp"

#include "display.hpp"
#include "plot_module.hpp"

namespace kestrel::app {
namespace {

const PlotModule& plot_module() {
  if (!has_display()) {
    throw std::runtime_error(
        "no display: DISPLAY is not set; run without --plot, the page shows "
        "the same plots");
  }
  return module_functions<PlotModule>("plot");
}

std::vector<PlotGraph> graphs(const std::vector<std::string>& laws) {
  return {{"error", "", laws},
          {"speed", "m/s", laws},
          {"turn rate", "rad/s", laws},
          {"condition number", "", laws}};
}

/// Length of a vector whose components are columns, row by row.
std::vector<double> length(const RunTrace& trace, const std::vector<std::string>& columns) {
  std::vector<double> sum(trace.rows.size(), 0);
  for (const std::string& name : columns) {
    const std::vector<double> values = trace.column(name);
    for (std::size_t i = 0; i < values.size(); ++i) sum[i] = std::hypot(sum[i], values[i]);
  }
  return sum;
}

/// The values of each graph, row by row.
std::vector<std::vector<double>> graphs_of(const LabRun& run) {
  const RunTrace& t = run.trace;
  if (run.kind == RunKind::Helicopter) {
    return {t.column("error_norm"),
            length(t, {"sent_forward_m_s", "sent_right_m_s", "sent_down_m_s"}),
            t.column("sent_yaw_rate_rad_s"), t.column("condition")};
  }
  return {t.column("error_norm"), length(t, {"vx_m_s", "vy_m_s", "vz_m_s"}),
          length(t, {"wx_rad_s", "wy_rad_s", "wz_rad_s"}), t.column("condition")};
}

}  // namespace

LivePlot::LivePlot(std::vector<std::string> laws)
    : module_(plot_module()),
      laws_(std::move(laws)),
      plots_(module_.open({"kestrel compare"}, graphs(laws_))) {}

LivePlot::~LivePlot() { module_.close(plots_); }

void LivePlot::draw(const LabRun& run) {
  const auto law = std::find(laws_.begin(), laws_.end(), run.law);
  if (law == laws_.end()) return;
  const std::string heading = run.scenario + (run.modifier.empty() ? "" : " " + run.modifier);
  if (heading != shown_) module_.begin(*plots_, heading);
  shown_ = heading;
  const std::vector<double> times_s = run.trace.column("time_s");
  const std::vector<std::vector<double>> graphs = graphs_of(run);
  for (std::size_t graph = 0; graph < graphs.size(); ++graph) {
    for (std::size_t i = 0; i < std::min(times_s.size(), graphs[graph].size()); ++i) {
      if (!std::isfinite(graphs[graph][i])) continue;
      module_.add(*plots_, int(graph), int(law - laws_.begin()), times_s[i], graphs[graph][i]);
    }
  }
}

}  // namespace kestrel::app
