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
  const bool small = theta < 1e-4;
  const double a = small ? 0.5 - theta * theta / 24 : (1 - std::cos(theta)) / (theta * theta);
  const double b =
      small ? 1.0 / 6 - theta * theta / 120 : (theta - std::sin(theta)) / (theta * theta * theta);
  const Eigen::Matrix3d left_jacobian = Eigen::Matrix3d::Identity() + a * S + b * S * S;
  return {rotation_from_vector(theta_u), left_jacobian * path};
}

}  // namespace kestrel
