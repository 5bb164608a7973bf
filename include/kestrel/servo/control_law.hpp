#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "kestrel/geometry/transform.hpp"
#include "kestrel/geometry/twist.hpp"
#include "kestrel/servo/feature.hpp"
#include "kestrel/servo/law.hpp"

namespace kestrel {

/// Columns: camera twists that the vehicle can make, e.g. cVb eJe. Six columns at most.
using TwistBasis = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 6>;

/// What a law may look at in one frame. What a law does not need may be left out; what it needs and
/// does not get is a refusal.
struct LawInput {
  /// s and the depths Z (m); NaN: a depth that is not known, which a law that does not use it
  /// takes.
  std::vector<Feature> measured;
  std::vector<Feature> desired;  // s*, Z*, same points in the same order
  /// Pose of the measuring camera in the goal camera, c*Mc (m).
  std::optional<Displacement> goal_from_camera;
  /// Pose of the target in the measuring camera and in the goal camera, cMo and c*Mo (m).
  std::optional<TargetPose> camera_from_target;
  std::optional<TargetPose> goal_from_target;
  /// Euclidean homography of the target's plane, normalised points of the goal's image to those
  /// of the measured one, any scale.
  std::optional<Eigen::Matrix3d> camera_from_goal_homography;
  /// What the camera did between the previous measurement and this one: the twist integrated over
  /// that time (m, rad). For the laws that learn; empty at the first measurement and after a loss.
  std::optional<Vector6d> camera_motion;
  /// The twists the camera can make; empty: all six.
  TwistBasis basis{};
  double time_s = 0;  // since the start of the servo task; for the smooth start
};

/// lambda, constant or by the size of what is still to do (ViSP: vpAdaptiveGain):
/// lambda(x) = (at_zero - at_infinity) exp(-slope x / (at_zero - at_infinity)) + at_infinity with
/// x = |J^+ e| (largest component; what the law answers for a gain of one). Constant when both ends
/// are equal; at_zero is not below at_infinity: near the goal there is less to do.
struct LawGain {
  double at_zero_per_s = 0.5;
  double at_infinity_per_s = 0.5;
  double slope_at_zero_per_s = 0;  // -dlambda/dx at x = 0, >= 0

  static LawGain constant(double gain_per_s) { return {gain_per_s, gain_per_s, 0}; }
  /// lambda(x), 1/s.
  double at(double x) const;
  /// Throws std::invalid_argument that names the first number out of range.
  void check() const;
};

/// Who solves cur, des, mean and their variants of depth: the same numbers to rounding.
enum class LawSolver {
  Eigen,  // "eigen": some microseconds, any number of threads at a time
  Visp,   // "visp": vpServo, slower; one call waits for the other
};

/// The word in quotes above.
const char* name(LawSolver solver);

/// Parameters of the laws.
struct LawOptions {
  Law law = Law::Mean;
  LawSolver solver = LawSolver::Eigen;
  LawGain gain{};
  /// Smooth start, v = v_law - exp(-mu t) v_law(0), v_law(0) at today's gain (ViSP:
  /// vpServo::computeControlLaw(t), mu = 4; without its blindness for the basis); 0: none.
  double smooth_start_per_s = 0;
  double rank_tolerance = 1e-6;  // singular values below this share of the largest count as zero
  /// A Jacobian worse conditioned than this has no answer; infinite: the pseudo-inverse answers
  /// whatever is finite.
  double max_condition = 1e4;
  double damping = 1e-4;            // mu of "lm"
  double learning_gate = 0.01;      // "broyden" learns when |ds| has grown to this
  double forgetting = 0.95;         // of "rls", in (0, 1]
  double initial_covariance = 1e4;  // of "rls"

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// What a law carries from one measurement to the next; a value.
struct LawState {
  Eigen::MatrixXd jacobian;    // learned, 2n x 6 (broyden, rls); empty before the first answer
  Eigen::MatrixXd covariance;  // of rls, 6 x 6
  Eigen::VectorXd features;    // s at the last update
  Vector6d motion = Vector6d::Zero();  // of the camera since then
  /// v_law(0) for a gain of one, for the smooth start.
  std::optional<Vector6d> first_twist;
};

/// Why a law gives no twist.
enum class LawRefusal {
  None,
  FewPoints,    // fewer than three (moments, area and homography: four)
  Unequal,      // measured and desired are not the same number of points
  NotFinite,    // a number is NaN, infinite or beyond 1e6
  Depth,        // a depth below 1e-6 m, or not known to a law that needs it
  Coincident,   // points at one place: fewer than three places are left
  Collinear,    // all points on one line, or hardly off it
  Pose,         // the law needs a pose
  Homography,   // the law needs a homography, or it is none
  Singular,     // condition above max_condition, or a feature of the law is not defined here
  Unreachable,  // the basis spans no twist
};

/// "none", "few_points", ...: for tables.
const char* name(LawRefusal refusal);

/// What a law answers.
struct LawAnswer {
  std::optional<CameraTwist> twist;  // of the camera, in the span of the basis; empty: hover
  LawRefusal refusal = LawRefusal::None;
  /// The law's own error (points: s - s*, (x0 y0 x1 y1 ...), normalised; pose laws: the six of the
  /// pose error; polar: rho and theta; ...).
  Eigen::VectorXd error;
  Eigen::VectorXd
      singular_values;  // of the Jacobian that was inverted, largest first; may be empty
  int rank = 0;
  double condition = 0;  // largest over smallest singular value
  double smallest_singular_value = 0;
  double gain_per_s = 0;  // that was used
  LawState next;          // to be given back at the next measurement
};

/// v = -gain Jhat^+ e, as the chosen law has it; exactly zero where e is. Pure: the same input,
/// state and options give the same answer, from any thread. Never throws for what a frame may
/// bring; a twist is finite. When there is none the state stays as it was.
LawAnswer control_law(const LawInput& input, const LawOptions& options, const LawState& state = {});

}  // namespace kestrel
