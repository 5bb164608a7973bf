#pragma once

#include <optional>

#include <Eigen/Core>

#include "kestrel/geometry/twist.hpp"
#include "kestrel/servo/control_law.hpp"

/// What the laws share whose twist is a formula, not the solution of a system.
namespace kestrel::laws {

/// c*Mc as given, or from the two poses of the target; empty when there is neither, or its rotation
/// is none.
std::optional<Displacement> goal_from_camera(const LawInput& input);

/// Rate of the rotation vector of c*Rc for the camera's angular velocity (L_theta_u; Malis,
/// Chaumette & Boudet 1999, eq. 17, with the sign of c*Rc): I + [theta u]x / 2 +
/// (1 - theta/2 cot(theta/2)) [u]x^2, the inverse of the right Jacobian of SO(3).
Eigen::Matrix3d rotation_vector_rate(const Eigen::Vector3d& theta_u);

/// Singular values of a regular matrix, largest first.
Eigen::VectorXd singular_values(const Matrix6d& L);

/// The answer -gain u of a law that knows u (the twist for a gain of one, its sign turned) without
/// inverting anything at run time, so that max_condition does not apply. The singular values are
/// those of the law's interaction matrix. In a basis: the part of u nearest to it (least squares,
/// metres and radians alike).
LawAnswer closed_form(const Vector6d& u, const Eigen::VectorXd& error,
                      const Eigen::VectorXd& values, const LawInput& input,
                      const LawOptions& options);

}  // namespace kestrel::laws
