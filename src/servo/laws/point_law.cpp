#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/SVD>

#include "kestrel/geometry/rotation.hpp"

#include "laws.hpp"
#include "point_features.hpp"
#include "pseudo_inverse.hpp"
#include "visp_law.hpp"

namespace kestrel::laws {
namespace {

/// The most by which R^T R may miss the identity in a pose.
constexpr double kRotationTolerance = 1e-6;

using Points = std::vector<Feature>;

/// The measured points with the depths the law believes in, or why there are none.
struct Believed {
  Points points;
  LawRefusal refusal = LawRefusal::None;
};

/// Z*, point by point.
Believed with_desired_depths(const LawInput& input) {
  Believed seen{input.measured};
  for (std::size_t i = 0; i < seen.points.size(); ++i) {
    seen.points[i].depth_m = input.desired[i].depth_m;
  }
  return seen;
}

/// One depth for all, Z* sqrt(a* / a): exact while the target is parallel to the image.
Believed with_depth_from_area(const LawInput& input) {
  Believed seen{input.measured};
  const double depth_m = mean_depth(input.desired) *
                         std::sqrt(polygon_area(input.desired) / polygon_area(input.measured));
  if (!(depth_m > 0 && std::isfinite(depth_m))) return {{}, LawRefusal::Singular};
  for (Feature& f : seen.points) f.depth_m = depth_m;
  return seen;
}

/// Z_i = Z*_i (H m*_i)_3, H a Euclidean homography R + t n^T / d once its second singular value
/// is 1 (Ma, Soatto, Kosecka & Sastry 2004, lemma 5.18).
Believed with_depths_from_homography(const LawInput& input) {
  if (!input.camera_from_goal_homography) return {{}, LawRefusal::Homography};
  Eigen::Matrix3d H = *input.camera_from_goal_homography;
  H /= Eigen::JacobiSVD<Eigen::Matrix3d>(H).singularValues()[1];
  Believed seen{input.measured};
  double sign = 0;
  for (std::size_t i = 0; i < seen.points.size(); ++i) {
    const ImagePoint& m = input.desired[i].at;
    const double share = H(2, 0) * m.x + H(2, 1) * m.y + H(2, 2);
    if (sign == 0) sign = std::copysign(1, share);
    seen.points[i].depth_m = input.desired[i].depth_m * share * sign;
    if (!(seen.points[i].depth_m > 0 && std::isfinite(seen.points[i].depth_m))) {
      return {{}, LawRefusal::Homography};
    }
  }
  return seen;
}

Believed believed(const LawInput& input, Law law) {
  switch (law) {
    case Law::CurZdes:
    case Law::MeanZdes:
      return with_desired_depths(input);
    case Law::CurZarea:
      return with_depth_from_area(input);
    case Law::CurZhomog:
      return with_depths_from_homography(input);
    default:
      return {input.measured};
  }
}

LawAnswer from_visp(const Points& seen, const LawInput& input, const LawOptions& options) {
  switch (options.law) {
    case Law::Des:
      return visp_law(VispMatrix::Desired, seen, input, options);
    case Law::Mean:
    case Law::MeanZdes:
      return visp_law(VispMatrix::Mean, seen, input, options);
    default:
      return visp_law(VispMatrix::Current, seen, input, options);
  }
}

/// (L^+ + L*^+) / 2 e; diagnosed by the worse of the two.
LawAnswer mean_of_inverses(const LawInput& input, const LawOptions& options) {
  const PseudoInverse now(in_basis(point_matrix(input.measured), input), options.rank_tolerance);
  const PseudoInverse goal(in_basis(point_matrix(input.desired), input), options.rank_tolerance);
  const bool goal_is_worse = goal.condition() > now.condition();
  LawAnswer answer = diagnosed(goal_is_worse ? goal : now, input, options);
  answer.error = point_error(input);
  if (answer.refusal != LawRefusal::None) return answer;
  const UpToSix u = (now * answer.error + goal * answer.error) / 2;
  return with_velocities(std::move(answer), u, input, options);
}

/// What takes a twist of the current camera to the goal's camera: a change of axes, or of axes and
/// origin.
std::optional<Matrix6d> moved_to_goal(const LawInput& input, Law law) {
  if (!input.goal_from_camera) return std::nullopt;
  const Eigen::Matrix3d& R = input.goal_from_camera->rotation;
  if (!(rotation_defect(R) <= kRotationTolerance)) return std::nullopt;
  const Eigen::Vector3d t =
      law == Law::PmjT ? input.goal_from_camera->translation : Eigen::Vector3d::Zero();
  return twist_matrix(R, t);
}

LawAnswer mean_in_one_frame(const LawInput& input, const LawOptions& options) {
  const std::optional<Matrix6d> goal_from_now = moved_to_goal(input, options.law);
  if (!goal_from_now) return refused(LawRefusal::Pose);
  const TaskJacobian goal = point_matrix(input.desired) * *goal_from_now;
  return solved((point_matrix(input.measured) + goal) / 2, point_error(input), input, options);
}

/// (J^T J + mu diag(J^T J))^-1 J^T e.
std::optional<UpToSix> damped(const TaskJacobian& J, const Eigen::VectorXd& e, double mu) {
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
  Square normal = J.transpose() * J;
  normal.diagonal() *= 1 + mu;
  const Eigen::LDLT<Square> factor(normal);
  if (factor.info() != Eigen::Success) return std::nullopt;
  const UpToSix right = J.transpose() * e;
  return UpToSix(factor.solve(right));
}

/// The laws that invert nothing, or something better than J; diagnosed by J.
LawAnswer descent(const LawInput& input, const LawOptions& options) {
  const TaskJacobian J = in_basis(point_matrix(input.measured), input);
  LawAnswer answer = diagnosed(PseudoInverse(J, options.rank_tolerance), input, options);
  answer.error = point_error(input);
  if (answer.refusal != LawRefusal::None) return answer;
  if (options.law == Law::Lm) {
    const std::optional<UpToSix> u = damped(J, answer.error, options.damping);
    if (u) return with_velocities(std::move(answer), *u, input, options);
    answer.refusal = LawRefusal::Singular;
    return answer;
  }
  UpToSix u = J.transpose() * answer.error;
  if (options.law == Law::Transpose) u /= answer.singular_values[0] * answer.singular_values[0];
  return with_velocities(std::move(answer), u, input, options);
}

LawAnswer inverse_of_one(const LawInput& input, const LawOptions& options) {
  const Believed seen = believed(input, options.law);
  if (seen.refusal != LawRefusal::None) return refused(seen.refusal);
  if (options.solver == LawSolver::Visp) return from_visp(seen.points, input, options);
  const Eigen::VectorXd error = point_error(input);
  if (options.law == Law::Des) return solved(point_matrix(input.desired), error, input, options);
  TaskJacobian L = point_matrix(seen.points);
  if (options.law == Law::Mean || options.law == Law::MeanZdes) {
    L = (L + point_matrix(input.desired)) / 2;
  }
  return solved(L, error, input, options);
}

}  // namespace

LawAnswer point_law(const LawInput& input, const LawOptions& options) {
  switch (options.law) {
    case Law::Mjp:
      return mean_of_inverses(input, options);
    case Law::PmjR:
    case Law::PmjT:
      return mean_in_one_frame(input, options);
    case Law::Lm:
    case Law::Transpose:
    case Law::TransposeRaw:
      return descent(input, options);
    default:
      return inverse_of_one(input, options);
  }
}

}  // namespace kestrel::laws
