#pragma once

#include <optional>

#include "kestrel/lab/camera_run.hpp"

namespace kestrel {

/// What a loop must do to count as stable.
enum class Stability {
  AtGoal,    // small errors near the goal do not grow
  Scenario,  // the run from the scenario's start converges
};

/// How margins are searched.
struct MarginOptions {
  Stability stability = Stability::AtGoal;
  double smallest_gain_per_s = 0.01;
  double largest_gain_per_s = 1000;
  double gain_tolerance = 1e-5;  // relative
  int largest_delay_frames = 120;
  /// Small errors start at this share of the scenario's start (of the screw from the goal).
  double offset_share = 1e-4;
  int steps = 1500;

  /// Throws std::invalid_argument that names the first one out of range.
  void check() const;
};

/// True when the loop is stable as the options say, under the setup's conditions (without noise).
bool is_stable(const CameraSetup& setup, const MarginOptions& options);

/// The largest constant gain (1/s) at which the loop is stable, by bisection between the smallest
/// and the largest; the largest when it is stable there; empty: unstable at the smallest. With an
/// integrator as plant and a measurement d frames of T old: 2 sin(pi / (2 (2 d + 1))) / T.
std::optional<double> gain_margin(const CameraSetup& setup, const MarginOptions& options);

/// The longest delay (frames) at which the loop is stable with the setup's gain, by bisection; the
/// largest when it is stable there; empty: unstable without delay.
std::optional<int> delay_margin(const CameraSetup& setup, const MarginOptions& options);

}  // namespace kestrel
