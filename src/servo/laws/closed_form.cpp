#include "closed_form.hpp"

#include <cmath>
#include <utility>

#include <Eigen/Eigenvalues>

#include "kestrel/geometry/rotation.hpp"

#include "laws.hpp"
#include "pseudo_inverse.hpp"

namespace kestrel::laws {
namespace {

/// The most by which R^T R may miss the identity in a pose.
constexpr double kRotationTolerance = 1e-6;

bool is_rotation(const Eigen::Matrix3d& R) { return rotation_defect(R) <= kRotationTolerance; }

}  // namespace

std::optional<Displacement> goal_from_camera(const LawInput& input) {
  Displacement motion;
  if (input.goal_from_camera) {
    motion = *input.goal_from_camera;
  } else if (input.camera_from_target && input.goal_from_target) {
    const auto pose = *input.goal_from_target * input.camera_from_target->inverse();
    motion = {pose.rotation, pose.translation};
  } else {
    return std::nullopt;
  }
  if (!is_rotation(motion.rotation)) return std::nullopt;
  return motion;
}

Eigen::Matrix3d rotation_vector_rate(const Eigen::Vector3d& theta_u) {
  const double theta = theta_u.norm();
  const double t2 = theta * theta;
  // (1 - theta/2 cot(theta/2)) / theta^2, by series where it cancels.
  const double c = theta < 1e-2 ? 1.0 / 12 + t2 / 720 * (1 + t2 / 42)
                                : (1 - theta / 2 / std::tan(theta / 2)) / t2;
  const Eigen::Matrix3d S = skew(theta_u);
  return Eigen::Matrix3d::Identity() + S / 2 + c * S * S;
}

Eigen::VectorXd singular_values(const Matrix6d& L) {
  const Eigen::SelfAdjointEigenSolver<Matrix6d> squares(L.transpose() * L, Eigen::EigenvaluesOnly);
  return squares.eigenvalues().reverse().cwiseMax(0).cwiseSqrt();
}

LawAnswer closed_form(const Vector6d& u, const Eigen::VectorXd& error,
                      const Eigen::VectorXd& values, const LawInput& input,
                      const LawOptions& options) {
  LawAnswer answer;
  answer.error = error;
  answer.singular_values = values;
  answer.rank = int(values.size());
  answer.smallest_singular_value = values[values.size() - 1];
  answer.condition = values[0] / answer.smallest_singular_value;
  if (!u.allFinite()) {
    answer.refusal = LawRefusal::Singular;
    return answer;
  }
  if (input.basis.cols() == 0) return with_velocities(std::move(answer), u, input, options);
  const PseudoInverse to_basis(input.basis, options.rank_tolerance);
  return with_velocities(std::move(answer), to_basis * Eigen::VectorXd(u), input, options);
}

}  // namespace kestrel::laws
