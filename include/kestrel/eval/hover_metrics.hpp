#pragma once

#include <optional>
#include <vector>

namespace kestrel {

/// Where the helicopter was against its goal at one moment.
struct FlightSample {
  double stamp_s = 0;
  double position_error_m = 0;   // distance from the goal
  double heading_error_rad = 0;  // yaw minus the goal's, in (-pi, pi]
  double target_distance_m = 0;  // camera to target plane, negative behind it
  bool seen = false;             // the target was found in this frame
};

/// When a flight counts as hovering at its goal, and when as failed.
struct HoverGoal {
  double position_m = 0.10;
  double heading_rad = 0.0349065850398866;  // 2 deg
  double hold_s = 2.0;                      // how long both must hold without a break
  double collision_m = 0.3;                 // nearer to the target plane than this
  double diverged_m = 50.0;                 // farther from the goal than this
  double lost_s = 5.0;                      // without the target for longer than this

  /// Throws std::invalid_argument that names the first value that is not positive and finite.
  void check() const;
};

/// How a flight ended.
enum class FlightEnd {
  Converged,  // held the goal for hold_s
  Collision,
  Diverged,  // or a number was not finite
  TargetLost,
  TimedOut,
};

/// What became of a flight.
struct HoverMetrics {
  FlightEnd end = FlightEnd::TimedOut;
  /// Stamp from which position and heading stayed within the goal's tolerance to the end of the
  /// flight; empty when they do not hold at its end.
  std::optional<double> settled_s;
  double final_position_m = 0;
  double final_heading_rad = 0;
  double seen_share = 0;  // frames with the target found / all
  double longest_unseen_s = 0;
};

/// The first named end a flight has come to, if any: to be asked after each sample, so that the
/// flight can stop. TimedOut is never among them.
std::optional<FlightEnd> ended(const std::vector<FlightSample>& flight, const HoverGoal& goal);

/// Metrics of a whole flight, in the order of its samples; TimedOut when nothing ended it.
HoverMetrics hover_metrics(const std::vector<FlightSample>& flight, const HoverGoal& goal);

/// "converged", "collision", "diverged", "target lost", "timed out".
const char* name(FlightEnd end);

}  // namespace kestrel
