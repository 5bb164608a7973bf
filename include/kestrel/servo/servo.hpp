#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "kestrel/geometry/transform.hpp"
#include "kestrel/geometry/twist.hpp"
#include "kestrel/servo/feature.hpp"

namespace kestrel {

/// Which approximation of the interaction matrix the law inverts (Chaumette & Hutchinson 2006,
/// section "Approximations of the interaction matrix"). L is taken at the measured features, L* at
/// the desired ones.
enum class Interaction {
  Current,  // L(s, Z)
  Desired,  // L(s*, Z*)
  Mean,     // (L(s, Z) + L(s*, Z*)) / 2
};

/// Which velocities of the vehicle the law may use; the columns of the body's Jacobian eJe.
enum class Freedom {
  Six,    // all six of the body twist
  Four,   // forward, right, down, yaw rate: a helicopter
  Three,  // forward, right, down: the paper's three references
};

/// Parameters of the servo law.
struct ServoOptions {
  Interaction interaction = Interaction::Mean;
  Freedom freedom = Freedom::Four;
  double gain_per_s = 0.5;

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// Above this condition of the task's Jacobian the law has no answer. Its largest singular value
/// being 2 or more, a pixel of noise (1e-3 or more on the normalised plane) may then answer with
/// 5 m/s or rad/s per unit of gain: nothing is left of the answer. A forward camera with four
/// freedoms, 5 m from a target of 1 m, is at 592; it gets there at 13 m. Mean and Desired keep the
/// better condition of the goal.
inline constexpr double kLargestCondition = 1e4;

/// What the law answers.
struct Servo {
  CameraTwist twist;      // of the camera, caused by the body velocities of the chosen freedom only
  Eigen::VectorXd error;  // e = s - s*, (x0 y0 x1 y1 ...), normalised image plane
  double condition = 0;   // largest over smallest singular value of L cVb eJe, L as chosen
};

/// v_c = cVb eJe u with u = -gain (L cVb eJe)^+ (s - s*): image-based visual servoing with the
/// camera on the vehicle (ViSP: vpServo, EYEINHAND_L_cVe_eJe; paper eq. (6)). measured and desired
/// are the same points in the same order, at least three, in the frame of the (levelled) camera.
/// Empty when a depth of either is below 1e-6 m, a number is not finite, the mount is no rotation,
/// or the points determine no twist (condition above kLargestCondition: too few, on a line, or
/// hardly told apart from that). Not to be called from two threads at a time: vpServo counts its
/// calls in a static variable.
std::optional<Servo> servo(const std::vector<Feature>& measured,
                           const std::vector<Feature>& desired, const Mount& body_from_camera,
                           const ServoOptions& options);

/// "current", "desired", "mean".
const char* name(Interaction interaction);

/// "six", "four", "three".
const char* name(Freedom freedom);

}  // namespace kestrel
