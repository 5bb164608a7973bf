#pragma once

#include <Eigen/Core>

namespace kestrel {

/// Skew-symmetric matrix [v]x with [v]x w = v x w.
Eigen::Matrix3d skew(const Eigen::Vector3d& v);

/// Rotation matrix of a rotation vector theta*u (axis times angle, rad): Rodrigues' formula.
Eigen::Matrix3d rotation_from_vector(const Eigen::Vector3d& theta_u);

/// Rotation vector theta*u (rad, |theta| <= pi) of a rotation matrix; inverse of the above.
Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& R);

/// R = Rz(yaw) Ry(pitch) Rx(roll), angles in rad: the vectors of a frame with this attitude,
/// seen from the frame it is measured against.
Eigen::Matrix3d rotation_from_rpy(double roll, double pitch, double yaw);

/// Largest absolute entry of R^T R - I, at least 2 for a reflection or a
/// matrix that is not finite: 0 for a rotation matrix.
double rotation_defect(const Eigen::Matrix3d& R);

/// The rotation nearest to M in the Frobenius norm (SVD, determinant +1); NaN when M is not finite.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& M);

/// Angle (rad) wrapped into (-pi, pi].
double wrap_angle(double angle);

}  // namespace kestrel
