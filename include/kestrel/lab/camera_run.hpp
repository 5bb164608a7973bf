#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "kestrel/geometry/twist.hpp"
#include "kestrel/lab/conditions.hpp"
#include "kestrel/lab/run_end.hpp"
#include "kestrel/lab/scenario.hpp"
#include "kestrel/servo/control_law.hpp"

namespace kestrel {

/// The thresholds by which a run is judged.
struct RunRules {
  double error_threshold = 1e-3;                     // |e| of the true points, normalised plane
  double still_threshold = 1e-5;                     // |v|, m/s and rad/s together
  double collision_m = 0.05;                         // least depth of a point
  double diverged_m = 50;                            // distance to the target's centre
  double pose_tolerance_share = 0.01;                // |t| over the goal's depth
  double pose_tolerance_rad = 0.017453292519943295;  // 1 deg
  bool stops_out_of_view = false;                    // a point beyond the image ends the run
  /// Ends the run as converged once |e| has stayed below this for settled_steps; 0: runs all steps.
  double settled_error = 0;
  int settled_steps = 30;

  /// Throws std::invalid_argument that names the first one out of range.
  void check() const;
};

/// Everything that decides a run of a free-flying camera.
struct CameraSetup {
  Scenario scenario;
  LabCamera camera{};
  LawOptions law{};
  Conditions conditions{};
  RunRules rules{};

  /// Throws std::invalid_argument that names the first thing out of range.
  void check() const;
};

/// The options of a law as the benchmark runs it: gain 1/s, and the pseudo-inverse answers however
/// ill conditioned its matrix is.
LawOptions benchmark_law(Law law);

/// One step of a run, the truth of it: all that a plot or a metric needs. Always finite.
struct RunStep {
  int step = 0;
  double time_s = 0;
  TargetPose camera_from_target;    // true
  GoalFromCamera goal_from_camera;  // true
  std::vector<Feature> points;      // true s and Z
  /// The true points minus those where the law believes them at the goal, (x0 y0 x1 y1 ...),
  /// normalised: s - s*, and with s* from a model, s - (kf s* + offset).
  Eigen::VectorXd error;
  CameraTwist twist{};  // applied, after limits; zero when the law gave none or the run ends here
  LawRefusal refusal = LawRefusal::None;
  bool saturated = false;
  int rank = 0;                        // of the law's matrix; 0: none was inverted
  double condition = 0;                // infinite when singular
  double smallest_singular_value = 0;  // valid when rank > 0
  Eigen::VectorXd singular_values;     // largest first; may be empty
};

/// How a run went as a whole.
struct RunResult {
  RunEnd end = RunEnd::TimedOut;
  LawRefusal refusal = LawRefusal::None;  // the last one, when refused
  int steps = 0;                          // observed
  double law_s = 0;                       // spent in the law by the clock given
};

/// Seconds of some clock; an empty one counts nothing.
using LabClock = std::function<double()>;

/// Lets the law steer a free camera from the scenario's start, c*Mc <- c*Mc exp(v / rate); each
/// step is told to `observe` in order, the last one included. Steps: pose, points, error; stop
/// rules; what the law is told; law; limits; observe; move. A law that gives no twist hovers.
/// Always ends, within conditions.steps; the same setup gives the same steps, bit by bit: chance
/// comes from conditions.seed alone. Throws std::invalid_argument as setup.check() does.
RunResult run_camera(const CameraSetup& setup, const std::function<void(const RunStep&)>& observe,
                     const LabClock& clock = {});

}  // namespace kestrel
