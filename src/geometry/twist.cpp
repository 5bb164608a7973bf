#include "kestrel/geometry/twist.hpp"

#include <cmath>

namespace kestrel {

Matrix6d twist_matrix(const Eigen::Matrix3d& R, const Eigen::Vector3d& t) {
  Matrix6d V = Matrix6d::Zero();
  V.topLeftCorner<3, 3>() = R;
  V.topRightCorner<3, 3>() = skew(t) * R;
  V.bottomRightCorner<3, 3>() = R;
  return V;
}

Displacement exponential(const Vector6d& twist, double duration_s) {
  const Eigen::Vector3d theta_u = twist.tail<3>() * duration_s;
  const Eigen::Vector3d path = twist.head<3>() * duration_s;
  const double theta = theta_u.norm();
  const Eigen::Matrix3d S = skew(theta_u);
  // (1 - cos)/theta^2 and (theta - sin)/theta^3, by series where the quotients cancel.
  const double t2 = theta * theta;
  const bool small = theta < 1e-2;
  const double a = small ? 0.5 - t2 / 24 * (1 - t2 / 30) : (1 - std::cos(theta)) / t2;
  const double b =
      small ? 1.0 / 6 - t2 / 120 * (1 - t2 / 42) : (theta - std::sin(theta)) / (t2 * theta);
  const Eigen::Matrix3d left_jacobian = Eigen::Matrix3d::Identity() + a * S + b * S * S;
  return {rotation_from_vector(theta_u), left_jacobian * path};
}

Vector6d logarithm(const Displacement& motion) {
  const Eigen::Vector3d theta_u = rotation_vector(motion.rotation);
  const Eigen::Matrix3d S = skew(theta_u);
  const double theta = theta_u.norm();
  const double t2 = theta * theta;
  // (1 - theta/2 cot(theta/2)) / theta^2, by series where it cancels.
  const double c = theta < 1e-2 ? 1.0 / 12 + t2 / 720 * (1 + t2 / 42)
                                : (1 - theta / 2 / std::tan(theta / 2)) / t2;
  const Eigen::Vector3d& t = motion.translation;
  return (Vector6d() << t - S * t / 2 + c * (S * (S * t)), theta_u).finished();
}

}  // namespace kestrel
