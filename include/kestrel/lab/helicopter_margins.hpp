#pragma once

#include <optional>
#include <vector>

#include "kestrel/lab/helicopter_run.hpp"

namespace kestrel {

/// How a margin is looked for.
struct HelicopterMarginOptions {
  double offset_m = 0.01;   // lateral, at the start: small, that the loop is linear
  double low_per_s = 0.05;  // gains to look between
  double high_per_s = 20;
  double relative_tolerance = 1e-3;  // of the gain found
  double shortest_s = 40;            // of a run ...
  int fewest_commands = 100;         // ... and as long as it takes to give these

  /// Throws std::invalid_argument that names the first one out of range.
  void check() const;
};

/// Whether the lateral loop settles at this gain: the setup flown without limits, noise and loss
/// from beside its goal; settled means that the lateral offset in the last quarter of the run stays
/// below the largest of the quarter before. The other loops may have lower limits (the vertical one
/// at 1.93 s per command: 1.75/s): longer runs let them grow out of the rounding.
bool settles_laterally(const HelicopterSetup& setup, double gain_per_s,
                       const HelicopterMarginOptions& options = {});

/// lambda_crit (1/s) of the lateral loop at the setup's timing, by bisection. Empty when the lowest
/// gain does not settle or the highest does.
std::optional<double> lateral_gain_limit(const HelicopterSetup& setup,
                                         const HelicopterMarginOptions& options = {});

/// The longest latency (frames) with which the lateral loop settles at the setup's own gain, by
/// bisection up to most_frames. Empty when it does not settle without latency.
std::optional<int> lateral_delay_limit(const HelicopterSetup& setup, int most_frames,
                                       const HelicopterMarginOptions& options = {});

/// A row of the table of gain limits.
struct GainLimitRow {
  int period_frames = 1;
  int delay_frames = 0;
  std::optional<double> limit_per_s;            // without prediction
  std::optional<double> predicted_limit_per_s;  // with it
};

/// The table of the benchmark for vp3 with des: 30 Hz with 0, 1, 3 and 6 frames of latency; 28
/// frames per command with none; 19, 28 and 58 with as much.
std::vector<GainLimitRow> gain_limit_table(const HelicopterMarginOptions& options = {});

}  // namespace kestrel
