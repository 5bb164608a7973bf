#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "kestrel/lab/lab_report.hpp"

namespace kestrel::test {

/// A camera run that nears its goal exponentially, with the columns that are drawn; one point.
inline LabRun made_up_run(const std::string& scenario, const std::string& law,
                          const std::string& modifier = "", int rows = 60) {
  LabRun run;
  run.id = scenario + "/" + law + (modifier.empty() ? "" : "/" + modifier);
  run.scenario = scenario;
  run.law = law;
  run.modifier = modifier;
  run.end = RunEnd::Converged;
  run.metrics = {{"k_error", 42.}, {"t_error_s", 1.4}, {"retreat_m", 0.25}, {"approach_m", 0.}};
  run.trace.columns = {"step",      "time_s",    "error_norm", "u0_px",    "v0_px",
                       "vx_m_s",    "tx_m",      "ty_m",       "tz_m",     "z0_m",
                       "condition", "sigma_min", "s1",         "saturated"};
  const double rate = 1 + 0.1 * double(law.size());
  for (int k = 0; k < rows; ++k) {
    const double t = k / 6.0;
    const double e = std::exp(-rate * t);
    run.trace.rows.push_back({double(k), t, e, 320 + 200 * e, 240 - 100 * e, -e, 0.3 * e, 0.1 * e,
                              -0.5 * e, 0.75 + e, 100 + e, 0.03, 3.3, 0});
  }
  return run;
}

/// The scene of such runs, turned about the optical axis by this angle (rad) at the start.
inline LabScene made_up_scene(const std::string& scenario, double angle_rad = 0) {
  LabScene scene;
  scene.scenario = scenario;
  scene.points_m = {{-.1, -.1, .75}, {.1, -.1, .75}, {.1, .1, .75}, {-.1, .1, .75}};
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  scene.start.axes << c, -s, 0, s, c, 0, 0, 0, 1;
  scene.goal_px = {{320, 240}};
  scene.limits = {{"vx_m_s", 1.0}};
  return scene;
}

/// Two laws on two scenarios, one of them also modified, names that need escaping, and one run that
/// ended badly.
inline LabReport made_up_report() {
  LabReport report;
  report.what = "Some <laws> & their runs.";
  report.scenes = {made_up_scene("S2_rz45", 0.785), made_up_scene("S3_rz90", 1.571)};
  for (const char* scenario : {"S2_rz45", "S3_rz90"}) {
    for (const char* law : {"cur", "a<b & \"c\""}) {
      report.runs.push_back(made_up_run(scenario, law));
      if (std::string(scenario) == "S3_rz90")
        report.runs.push_back(made_up_run(scenario, law, "kz2"));
    }
  }
  report.runs.back().end = RunEnd::Collision;
  return report;
}

}  // namespace kestrel::test
