#pragma once

#include <optional>
#include <vector>

#include "kestrel/lab/helicopter_run.hpp"

namespace kestrel {

/// What a gain margin is looked for in.
struct HelicopterMarginOptions {
  double offset_m = 0.01;   // lateral, at the start: small, that the loop is linear
  double low_per_s = 0.05;  // stable
  double high_per_s = 20;   // not
  double tolerance_per_s = 0.002;
  double duration_s = 120;  // of a run
  void check() const;
};

/// The gain limit lambda_crit (1/s) of the lateral loop at this timing: the experiment is flown
/// from its goal, moved aside by offset_m, without limits; a run is stable when the offset of its
/// last quarter is below that of the quarter before. By bisection. Empty when low is unstable or
/// high stable.
std::optional<double> lateral_gain_limit(const HelicopterExperiment& experiment,
                                         const HelicopterMarginOptions& options = {});

/// A row of the table of gain limits.
struct GainLimitRow {
  int period_frames = 1;
  int delay_frames = 0;
  std::optional<double> limit_per_s;            // without prediction
  std::optional<double> predicted_limit_per_s;  // with it
};

/// The table of the benchmark: vp3 with des at 30 Hz with 0, 1, 3 and 6 frames of latency, and at
/// 28, 19 and 58 frames per command, with none and with as many frames of latency.
std::vector<GainLimitRow> gain_limit_table(const HelicopterMarginOptions& options = {});

}  // namespace kestrel
