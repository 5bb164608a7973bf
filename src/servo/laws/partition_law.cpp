#include <cmath>
#include <utility>

#include <Eigen/SVD>

#include "kestrel/geometry/rotation.hpp"

#include "laws.hpp"
#include "outline.hpp"
#include "point_features.hpp"
#include "pseudo_inverse.hpp"

namespace kestrel::laws {
namespace {

/// Direction of the edge from the first point to the second.
double edge_angle(const std::vector<Feature>& points) {
  return std::atan2(points[1].at.y - points[0].at.y, points[1].at.x - points[0].at.x);
}

/// What the optical axis is to do for a gain of one, its sign turned: (vz, wz) =
/// gain (Z* ln(sigma* / sigma), theta - theta*) with sigma the root of the outline's area and theta
/// the angle of the edge 0-1.
Eigen::Vector2d axis_velocities(const LawInput& input) {
  const auto order = outline_order(input.desired);
  const double ratio = Outline(input.desired, order).area() / Outline(input.measured, order).area();
  return {-mean_depth(input.desired) * std::log(ratio) / 2,
          -wrap_angle(edge_angle(input.measured) - edge_angle(input.desired))};
}

/// The velocities of the basis in two parts: those that make given velocities (vz, wz) as well as
/// the basis can, and those that leave them alone.
struct Split {
  Eigen::Matrix<double, Eigen::Dynamic, 2, 0, 6, 2> along;  // from (vz, wz)
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6> across;
};

Split split(const TwistBasis& basis, double rank_tolerance) {
  Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, 6> axis(2, basis.cols());
  axis << basis.row(2), basis.row(5);
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(axis, Eigen::ComputeFullU | Eigen::ComputeFullV);
  svd.setThreshold(rank_tolerance);
  return {svd.solve(Eigen::Matrix2d::Identity()),
          svd.matrixV().rightCols(basis.cols() - svd.rank())};
}

Split split_of_all_six() {
  Split all;
  all.along.setZero(6, 2);
  all.across.setZero(6, 4);
  all.along(2, 0) = all.along(5, 1) = 1;
  all.across(0, 0) = all.across(1, 1) = all.across(3, 2) = all.across(4, 3) = 1;
  return all;
}

}  // namespace

/// Corke & Hutchinson 2001: translation along and rotation about the optical axis by size and
/// direction of the target, the rest by -L_xy^+ (gain e + L_z (vz, wz)), so that turns about the
/// axis bring no retreat. In a basis the rest is what does not move the axis' two velocities.
LawAnswer partition_law(const LawInput& input, const LawOptions& options) {
  if (input.measured.size() < 4) return refused(LawRefusal::FewPoints);
  const Eigen::Vector2d axis = axis_velocities(input);
  if (!axis.allFinite()) return refused(LawRefusal::Singular);
  const bool all_six = input.basis.cols() == 0;
  const Split parts = all_six ? split_of_all_six() : split(input.basis, options.rank_tolerance);
  const Eigen::VectorXd error = point_error(input);
  UpToSix u = parts.along * axis;
  if (parts.across.cols() == 0) return refused(LawRefusal::Unreachable);
  const TaskJacobian L = in_basis(point_matrix(input.measured), input);
  const TaskJacobian rest = L * parts.across;
  const PseudoInverse inverse(rest, options.rank_tolerance);
  LawAnswer answer = diagnosed(inverse, input, options);
  answer.error = error;
  if (answer.refusal != LawRefusal::None) return answer;
  const Eigen::VectorXd left = error - L * u;
  u += parts.across * (inverse * left);
  return with_velocities(std::move(answer), u, input, options);
}

}  // namespace kestrel::laws
