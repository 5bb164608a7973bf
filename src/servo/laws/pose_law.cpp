#include <cmath>

#include "kestrel/geometry/rotation.hpp"
#include "kestrel/geometry/twist.hpp"

#include "closed_form.hpp"
#include "laws.hpp"

namespace kestrel::laws {
namespace {

/// Straight path of the camera: v = -gain R^T t, w = -gain theta u with (R, t) = c*Mc (Chaumette &
/// Hutchinson 2006, eq. 23). de/dt = [R 0; 0 L_theta_u] v.
LawAnswer camera_law(const Displacement& motion, const LawInput& input, const LawOptions& options) {
  const Eigen::Vector3d theta_u = rotation_vector(motion.rotation);
  const Vector6d error = (Vector6d() << motion.translation, theta_u).finished();
  const Vector6d u =
      (Vector6d() << motion.rotation.transpose() * motion.translation, theta_u).finished();
  Matrix6d L = Matrix6d::Zero();
  L.topLeftCorner<3, 3>() = motion.rotation;
  L.bottomRightCorner<3, 3>() = rotation_vector_rate(theta_u);
  return closed_form(u, error, singular_values(L), input, options);
}

/// Straight path of the target's origin in the camera: v = -gain ((c*to - cto) + [cto]x theta u),
/// w = -gain theta u (Chaumette & Hutchinson 2006, eq. 21). de/dt = [-I [cto]x; 0 L_theta_u] v.
LawAnswer target_law(const Displacement& motion, const LawInput& input, const LawOptions& options) {
  if (!input.camera_from_target || !input.goal_from_target) return refused(LawRefusal::Pose);
  const Eigen::Vector3d& now = input.camera_from_target->translation;
  const Eigen::Vector3d& goal = input.goal_from_target->translation;
  const Eigen::Vector3d theta_u = rotation_vector(motion.rotation);
  const Vector6d error = (Vector6d() << now - goal, theta_u).finished();
  const Vector6d u = (Vector6d() << goal - now + now.cross(theta_u), theta_u).finished();
  Matrix6d L = Matrix6d::Zero();
  L.topLeftCorner<3, 3>() = -Eigen::Matrix3d::Identity();
  L.topRightCorner<3, 3>() = skew(now);
  L.bottomRightCorner<3, 3>() = rotation_vector_rate(theta_u);
  return closed_form(u, error, singular_values(L), input, options);
}

/// Rate of log(c*Mc) for the camera's twist: the inverse of the right Jacobian of SE(3),
/// f(ad) = ad/2 + ad/2 coth(ad/2) with ad that of the screw. Its eigenvalues are 0 and +-i theta,
/// all double, so the even part is 1 + a ad^2 + b ad^4 with value and slope of
/// g(theta) = theta/2 cot(theta/2) = 1 - a theta^2 + b theta^4.
Matrix6d screw_rate(const Vector6d& screw) {
  Matrix6d ad = Matrix6d::Zero();
  ad.topLeftCorner<3, 3>() = ad.bottomRightCorner<3, 3>() = skew(screw.tail<3>());
  ad.topRightCorner<3, 3>() = skew(screw.head<3>());
  const double theta = screw.tail<3>().norm();
  const double t2 = theta * theta;
  double a = 1.0 / 12 - t2 * t2 / 30240;  // series: beyond theta^4 / 30240, 1e-14
  double b = -1.0 / 720 - t2 / 15120;
  if (theta > 5e-2) {
    const double half = theta / 2;
    const double gap = 1 - half / std::tan(half);
    // theta d(gap)/dtheta
    const double slope = half * (half / (std::sin(half) * std::sin(half)) - 1 / std::tan(half));
    a = (4 * gap - slope) / (2 * t2);
    b = (2 * gap - slope) / (2 * t2 * t2);
  }
  const Matrix6d ad2 = ad * ad;
  return Matrix6d::Identity() + ad / 2 + a * ad2 + b * ad2 * ad2;
}

/// The screw motion to the goal: v = -gain log(c*Mc); the twist keeps its axis and direction.
LawAnswer screw_law(const Displacement& motion, const LawInput& input, const LawOptions& options) {
  const Vector6d screw = logarithm(motion);
  return closed_form(screw, screw, singular_values(screw_rate(screw)), input, options);
}

}  // namespace

LawAnswer pose_law(const LawInput& input, const LawOptions& options) {
  const auto motion = goal_from_camera(input);
  if (!motion) return refused(LawRefusal::Pose);
  if (options.law == Law::PbvsCo) return target_law(*motion, input, options);
  if (options.law == Law::Screw) return screw_law(*motion, input, options);
  return camera_law(*motion, input, options);
}

}  // namespace kestrel::laws
