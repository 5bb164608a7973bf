#include <cmath>

#include "kestrel/geometry/rotation.hpp"

#include "closed_form.hpp"
#include "laws.hpp"

namespace kestrel::laws {
namespace {

constexpr double kSmallestDepth_m = 1e-6;

/// 2 1/2 D (Malis, Chaumette & Boudet 1999): e = (X - X*, Y - Y*, ln Z/Z*, theta u) of a reference
/// point (X, Y, 1) Z, here the target's origin; de/dt = [L_v L_w; 0 L_theta_u] v.
struct Hybrid {
  double x = 0, y = 0, z_m = 0;
  Eigen::Vector3d error;  // of the point
  Eigen::Vector3d theta_u;

  Eigen::Matrix3d translation_rate() const {
    return (Eigen::Matrix3d() << -1, 0, x, 0, -1, y, 0, 0, -1).finished() / z_m;
  }
  Eigen::Matrix3d translation_rate_inverse() const {
    return (Eigen::Matrix3d() << -1, 0, -x, 0, -1, -y, 0, 0, -1).finished() * z_m;
  }
  Eigen::Matrix3d rotation_rate() const {
    return (Eigen::Matrix3d() << x * y, -(1 + x * x), y, 1 + y * y, -x * y, -x, -y, x, 0)
        .finished();
  }
};

Hybrid hybrid(const Eigen::Vector3d& now, const Eigen::Vector3d& goal,
              const Eigen::Matrix3d& R_goal_camera) {
  Hybrid h;
  h.x = now.x() / now.z();
  h.y = now.y() / now.z();
  h.z_m = now.z();
  h.error << h.x - goal.x() / goal.z(), h.y - goal.y() / goal.z(), std::log(now.z() / goal.z());
  h.theta_u = rotation_vector(R_goal_camera);
  return h;
}

}  // namespace

/// w = -gain theta u and v = -L_v^-1 (gain e + L_w w): the rotation is undone on its own, the
/// translation keeps the reference point on a straight line in the image.
LawAnswer hybrid_law(const LawInput& input, const LawOptions& options) {
  const auto motion = goal_from_camera(input);
  if (!motion || !input.camera_from_target || !input.goal_from_target) {
    return refused(LawRefusal::Pose);
  }
  const Eigen::Vector3d& now = input.camera_from_target->translation;
  const Eigen::Vector3d& goal = input.goal_from_target->translation;
  if (!(now.z() >= kSmallestDepth_m && goal.z() >= kSmallestDepth_m)) {
    return refused(LawRefusal::Depth);
  }
  const Hybrid h = hybrid(now, goal, motion->rotation);
  const Eigen::Vector3d linear =
      h.translation_rate_inverse() * (h.error - h.rotation_rate() * h.theta_u);
  Matrix6d L = Matrix6d::Zero();
  L.topLeftCorner<3, 3>() = h.translation_rate();
  L.topRightCorner<3, 3>() = h.rotation_rate();
  L.bottomRightCorner<3, 3>() = rotation_vector_rate(h.theta_u);
  const Vector6d u = (Vector6d() << linear, h.theta_u).finished();
  const Vector6d error = (Vector6d() << h.error, h.theta_u).finished();
  return closed_form(u, error, singular_values(L), input, options);
}

}  // namespace kestrel::laws
