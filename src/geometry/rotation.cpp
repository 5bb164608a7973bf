#include "kestrel/geometry/rotation.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <Eigen/SVD>

namespace kestrel {

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d S;
  S << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return S;
}

Eigen::Matrix3d rotation_from_vector(const Eigen::Vector3d& theta_u) {
  const double theta = theta_u.norm();
  if (theta == 0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(theta, theta_u / theta).toRotationMatrix();
}

Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& R) {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

Eigen::Matrix3d rotation_from_rpy(double roll, double pitch, double yaw) {
  using Eigen::AngleAxisd;
  return (AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
          AngleAxisd(roll, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

double rotation_defect(const Eigen::Matrix3d& R) {
  if (!R.allFinite()) return 2;
  const double defect = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  return R.determinant() > 0 ? defect : std::fmax(defect, 2);
}

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& M) {
  if (!M.allFinite()) return Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN());
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1.0 : 1.0;
  return svd.matrixU() * Eigen::Vector3d(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
}

double wrap_angle(double angle) {
  const double wrapped = std::remainder(angle, 2 * M_PI);
  return wrapped == -M_PI ? M_PI : wrapped;
}

}  // namespace kestrel
