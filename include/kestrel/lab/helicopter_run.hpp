#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "kestrel/lab/helicopter_scenario.hpp"
#include "kestrel/lab/lab_run.hpp"
#include "kestrel/servo/helicopter_law.hpp"
#include "kestrel/sim/helicopter.hpp"
#include "kestrel/vehicle/failsafe.hpp"
#include "kestrel/vehicle/limits.hpp"

namespace kestrel {

/// What is sent while the target is not seen.
enum class LossReaction {
  Failsafe,  // "failsafe": hold, decay, hover (vehicle/failsafe)
  Hold,      // "hold": the last command for ever
  Hover,     // "hover": zeros at once
};

/// A time in which the target is not seen: images taken in [from_s, from_s + for_s).
struct TargetLoss {
  double from_s = 0;
  double for_s = 0;
};

/// The modifiers of a helicopter run: what the law is told wrongly, late or coarsely, and what is
/// done with its answer.
struct HelicopterConditions {
  double gain_per_s = 0.5;   // lambda, and lambda_psi of the heading hold
  double duration_s = 40;    // in frames of 1/30 s
  int period_frames = 1;     // p: the command is computed at frames k with k mod p = 0
  int delay_frames = 0;      // d: from the image of frame max(0, k - d)
  bool predicted = false;    // the features are moved over the latency with the known motion
  double depth_factor = 1;   // depths given to the law over the true ones, translations too
  double noise_px = 0;       // standard deviation of each pixel coordinate
  std::uint64_t seed = 42;   // of the noise
  double roll_bias_rad = 0;  // of the attitude given to the law, minus the true one
  double pitch_bias_rad = 0;
  double yaw_bias_rad = 0;
  double focal_px = 600;  // with the principal point in the middle of width x height
  int width_px = 640;
  int height_px = 480;
  /// The velocity of the target is known and added to the command (moving targets).
  bool feed_forward = false;
  std::optional<CommandLimits> limits{};
  std::optional<TargetLoss> loss{};
  LossReaction reaction = LossReaction::Failsafe;
  LossOptions failsafe{};
  HelicopterOptions plant{};

  /// Throws std::invalid_argument that names the first one out of range.
  void check() const;
};

/// By what a helicopter run is judged.
struct HelicopterRules {
  double position_tolerance_m = 0.10;
  double heading_tolerance_rad = 0.034906585039886591;  // 2 deg
  double collision_m = 0.05;                            // a point nearer ends the run
  double diverged_m = 50;  // from the goal; farther, or not finite, ends the run
  bool stops_out_of_view = false;

  void check() const;
};

/// One run of the helicopter benchmark.
struct HelicopterExperiment {
  std::string id;        // as in LabRun
  std::string label;     // of the law: LabRun::law
  std::string modifier;  // LabRun::modifier
  HelicopterScenario scenario;
  HelicopterLawOptions law;  // its gains are replaced by those of the conditions
  HelicopterConditions conditions;
  HelicopterRules rules;

  void check() const;
};

/// Reads a clock of processor time, s; empty: law_us stays 0.
using LabClock = std::function<double()>;

/// Flies the experiment on sim/helicopter: 30 frames per second, in each the state is recorded,
/// maybe a command computed, and the plant advanced by 1/30 s with the command held. Ends:
/// Converged (position and heading within tolerance at the end), PositionOnly, HeadingOnly,
/// TimedOut (neither), Refused (neither, and the law gave no answer at the end), Collision,
/// Diverged, OutOfView. Columns of the trace: step, time_s, north_m, east_m, down_m, roll_rad,
/// pitch_rad, yaw_rad (of the body), north_m_s, east_m_s, down_m_s, yaw_rate_rad_s, wanted_* and
/// sent_* (forward_m_s, right_m_s, down_m_s, yaw_rate_rad_s: before and after limits and failsafe),
/// u_i_px, v_i_px (true image points), error_norm (true points levelled, normalised plane),
/// condition, sigma_min (of the law), position_error_m, heading_error_rad, seen, refused,
/// saturated. Deterministic but for law_us.
LabRun run(const HelicopterExperiment& experiment, const LabClock& clock = {});

/// "failsafe", "hold", "hover".
const char* name(LossReaction reaction);

}  // namespace kestrel
