#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "kestrel/geometry/transform.hpp"
#include "kestrel/geometry/twist.hpp"
#include "kestrel/servo/control_law.hpp"
#include "kestrel/servo/feature.hpp"
#include "kestrel/servo/law.hpp"

namespace kestrel {

/// Which velocities of the vehicle the law may use; the columns of the body's Jacobian eJe.
enum class Freedom {
  Six,    // all six of the body twist
  Four,   // forward, right, down, yaw rate: a helicopter
  Three,  // forward, right, down: the paper's three references
};

/// Parameters of the servo law.
struct ServoOptions {
  Law law = Law::Mean;
  Freedom freedom = Freedom::Four;
  double gain_per_s = 0.5;  // with a far gain: that of the goal, where the answer is zero
  /// Gain where much is left to do, not above gain_per_s; empty: the same everywhere. See LawGain.
  std::optional<double> far_gain_per_s{};
  double gain_slope_per_s = 30;  // how fast the one becomes the other; only with a far gain
  double smooth_start_per_s = 0;
  double damping = LawOptions{}.damping;
  double learning_gate = LawOptions{}.learning_gate;
  double forgetting = LawOptions{}.forgetting;
  double initial_covariance = LawOptions{}.initial_covariance;

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// The same for control_law(): vpServo solves what it can, condition up to kLargestCondition.
LawOptions law_options(const ServoOptions& options);

/// Above this condition of the task's Jacobian the law has no answer. Its largest singular value
/// being 2 or more, a pixel of noise (1e-3 or more on the normalised plane) may then answer with
/// 5 m/s or rad/s per unit of gain: nothing is left of the answer. A forward camera with four
/// freedoms, 5 m from a target of 1 m, is at 592; it gets there at 13 m. Mean and Desired keep the
/// better condition of the goal.
inline constexpr double kLargestCondition = 1e4;

/// What the law answers.
struct Servo {
  CameraTwist twist;      // of the camera, caused by the body velocities of the chosen freedom only
  Eigen::VectorXd error;  // the law's: of points e = s - s*, (x0 y0 x1 y1 ...), normalised plane
  double condition = 0;   // largest over smallest singular value of L cVb eJe, L as chosen
};

/// cVb eJe: the twists of the camera that the body's velocities of this freedom cause.
TwistBasis body_basis(const Mount& body_from_camera, Freedom freedom);

/// The law on a body: control_law() with the basis cVb eJe; the input's own is not looked at. All
/// of the input is in the frame of the (levelled) camera. Refuses Unreachable when the mount is no
/// rotation or its lever arm is beyond 1e6 m, NotFinite for a gain that is not.
LawAnswer law_on_body(LawInput input, const Mount& body_from_camera, const ServoOptions& options,
                      const LawState& state = {});

/// v_c = cVb eJe u with u = -gain (L cVb eJe)^+ (s - s*): image-based visual servoing with the
/// camera on the vehicle (ViSP: vpServo, EYEINHAND_L_cVe_eJe; paper eq. (6)), law_on_body() for the
/// laws that need nothing but points. measured and desired are the same points in the same order,
/// at least three, in the frame of the (levelled) camera. Empty when that refuses.
std::optional<Servo> servo(const std::vector<Feature>& measured,
                           const std::vector<Feature>& desired, const Mount& body_from_camera,
                           const ServoOptions& options);

/// "six", "four", "three".
const char* name(Freedom freedom);

}  // namespace kestrel
