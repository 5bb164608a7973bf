#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "kestrel/lab/camera_run.hpp"
#include "kestrel/lab/helicopter_conditions.hpp"
#include "kestrel/lab/helicopter_scenario.hpp"
#include "kestrel/servo/helicopter_law.hpp"

namespace kestrel {

/// The plant and the image source go at this rate.
inline constexpr double kHelicopterFrame_s = 1.0 / 30;

/// By what a helicopter run is judged.
struct HelicopterRules {
  double position_tolerance_m = 0.10;
  double heading_tolerance_rad = 0.034906585039886591;  // 2 deg
  /// Below this the helicopter stands still: m/s and rad/s together, of its motion and of what the
  /// law asks for. Another run of 40 s at this speed moves it by 4 mm and turns it by 0.23 deg: a
  /// twenty-fifth and a ninth of the tolerances.
  double still_threshold = 1e-4;
  /// Stillness counts when it has lasted for so long: longer than the slowest vehicle of the paper
  /// takes from an image to the end of its answer (1.93 s of latency and as much between images).
  double still_s = 5;
  double collision_m = 0.05;       // least depth of a point
  double diverged_m = 50;          // distance to the goal
  bool stops_out_of_view = false;  // a point beyond the image ends the run

  /// Throws std::invalid_argument that names the first one out of range.
  void check() const;
};

/// Everything that decides a run of a helicopter.
struct HelicopterSetup {
  HelicopterScenario scenario;
  LabCamera camera{};
  HelicopterLawOptions law{};
  HelicopterConditions conditions{};
  HelicopterRules rules{};

  /// Throws std::invalid_argument that names the first thing out of range.
  void check() const;
};

/// The world in one frame.
struct HelicopterFrame {
  int step = 0;
  double time_s = 0;
  HelicopterState state;
  Transform<frame::World, frame::Camera> world_from_camera;
  TargetPose camera_from_target;
  std::vector<Feature> points;  // of the tilted camera, without noise
};

/// One frame of a run, the truth of it: all that a plot or a figure needs. Always finite.
struct HelicopterStep {
  HelicopterFrame frame;
  Eigen::Vector3d position_error_m = Eigen::Vector3d::Zero();  // camera minus goal, NED
  double heading_error_rad = 0;
  double error_norm = 0;   // |s - s*| of the true points, truly levelled, normalised plane
  VelocityCommand wanted;  // before limits and failsafe
  VelocityCommand sent;
  bool seen = true;  // the image of the last command
  LawRefusal refusal = LawRefusal::None;
  bool saturated = false;              // the limits changed the command
  int rank = 0;                        // of the law's matrix; 0: none was inverted
  double condition = 0;                // infinite when singular
  double smallest_singular_value = 0;  // valid when rank > 0
};

/// Flies the setup on sim/helicopter: in each frame the world is looked at, maybe a command is
/// computed (helicopter_law, limits over the time since the command before, failsafe when there is
/// no answer, by the time since the frame of the last one), the step is told to `observe`, and the
/// plant goes on for 1/30 s with the command held. The last step is the world at the end; nothing
/// is decided in it. Ends: Converged (position and heading are within tolerance at the end),
/// PositionOnly, HeadingOnly; neither: Refused (the law gave no answer at the end), LocalMinimum
/// (it sees the target and has stood still for still_s), TimedOut; Collision, Diverged, OutOfView.
/// The same setup gives the same steps, bit by bit.
/// Throws std::invalid_argument as setup.check() does.
RunResult run_helicopter(const HelicopterSetup& setup,
                         const std::function<void(const HelicopterStep&)>& observe,
                         const LabClock& clock = {});

}  // namespace kestrel
