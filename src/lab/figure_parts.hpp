#pragma once

#include <string>
#include <vector>

#include "kestrel/io/svg_plot.hpp"
#include "kestrel/lab/lab_report.hpp"

/// What the still pictures of the laboratory share.
namespace kestrel::figures {

/// A run with the place of its law, which gives it its look, and its thinned trace.
struct DrawnRun {
  const LabRun* run = nullptr;
  int law = 0;
  RunTrace trace;
};

/// The runs of a scenario under a modifier.
std::vector<DrawnRun> drawn_runs(const LabReport& report, const std::string& scenario,
                                 const std::string& modifier);

/// The stroke of a law: with the seven colours 28 looks.
Stroke stroke_of(int law);

/// A line of the law over time: `column` against time_s, until until_s.
Series over_time(const DrawnRun& drawn, const std::string& column, double until_s);

/// The time until which there is something to see: somewhat past the last convergence or early
/// end.
double horizon_s(const std::vector<DrawnRun>& runs);

}  // namespace kestrel::figures
