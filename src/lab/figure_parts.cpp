#include "figure_parts.hpp"

#include <algorithm>
#include <cmath>

#include "kestrel/lab/trace_thinning.hpp"

namespace kestrel::figures {
namespace {

constexpr std::size_t kRows = 70;  // of a line: more cannot be seen on paper
constexpr int kPalette = 7;

}  // namespace

std::vector<DrawnRun> drawn_runs(const LabReport& report, const std::string& scenario,
                                 const std::string& modifier) {
  const LabNames laws = laws_of(report.runs);
  std::vector<DrawnRun> out;
  for (const LabRun& run : report.runs) {
    if (run.scenario != scenario || run.modifier != modifier) continue;
    out.push_back({&run, laws.place(run.law), thinned(run.trace, kRows)});
  }
  return out;
}

Stroke stroke_of(int law) {
  constexpr Stroke kStrokes[] = {Stroke::Solid, Stroke::Dashed, Stroke::Dotted, Stroke::DashDot};
  return kStrokes[law / kPalette % 4];
}

Series over_time(const DrawnRun& drawn, const std::string& column, double until_s) {
  Series series{drawn.run->law, {}, {}, drawn.law, stroke_of(drawn.law)};
  const std::vector<double> times = drawn.trace.column("time_s");
  const std::vector<double> values = drawn.trace.column(column);
  if (values.empty()) return series;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] <= until_s) {
      series.x.push_back(times[i]);
      series.y.push_back(values[i]);
      continue;
    }
    if (i == 0) break;
    const double share = (until_s - times[i - 1]) / (times[i] - times[i - 1]);
    series.x.push_back(until_s);
    // An error decays exponentially: between two rows it is a straight line on its own axis.
    const bool decays = column == "error_norm" && values[i - 1] > 0 && values[i] > 0;
    series.y.push_back(decays ? values[i - 1] * std::pow(values[i] / values[i - 1], share)
                              : values[i - 1] + share * (values[i] - values[i - 1]));
    break;
  }
  return series;
}

double horizon_s(const std::vector<DrawnRun>& runs) {
  double all_s = 0;
  for (const DrawnRun& drawn : runs) {
    const auto times = drawn.trace.column("time_s");
    if (!times.empty()) all_s = std::max(all_s, times.back());
  }
  double last_s = 0;
  for (const DrawnRun& drawn : runs) {
    const auto times = drawn.trace.column("time_s");
    auto end_s = figure(*drawn.run, "t_error_s");
    if (!end_s) end_s = figure(*drawn.run, "settle_s");
    if (!end_s && !times.empty() && drawn.run->end != RunEnd::Converged) end_s = times.back();
    if (end_s && *end_s < 0.7 * all_s) last_s = std::max(last_s, *end_s);
  }
  return last_s > 0 ? std::min(all_s, 1.25 * last_s) : all_s;
}

}  // namespace kestrel::figures
