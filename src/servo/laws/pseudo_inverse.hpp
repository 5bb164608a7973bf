#pragma once

#include <Eigen/Core>
#include <Eigen/QR>
#include <Eigen/SVD>

#include "kestrel/servo/control_law.hpp"

namespace kestrel::laws {

using UpToSix = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;
/// One row a number of the error, one column a velocity.
using TaskJacobian = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, Eigen::Dynamic, 6>;

/// J^+ by the singular value decomposition of the triangle of a QR decomposition: the singular
/// values are those of J, and the iteration works on six columns and rows at most.
class PseudoInverse {
 public:
  /// Singular values below rank_tolerance times the largest count as zero.
  PseudoInverse(const TaskJacobian& J, double rank_tolerance);

  /// J^+ e.
  UpToSix operator*(const Eigen::VectorXd& e) const;

  UpToSix singular_values() const { return svd_.singularValues(); }  // largest first
  int rank() const { return int(svd_.rank()); }
  /// Largest over smallest singular value; infinite when the smallest is zero, NaN for J = 0.
  double condition() const;

 private:
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
  Eigen::HouseholderQR<TaskJacobian> qr_;
  Eigen::JacobiSVD<Square> svd_;
};

/// The twists the law may use: the input's basis, or all six.
TwistBasis basis_of(const LawInput& input);

/// L basis; L when the basis is empty.
TaskJacobian in_basis(const TaskJacobian& L, const LawInput& input);

/// What the decomposition tells, put into an answer; refusal Singular when the condition is above
/// the largest, Unreachable when the basis spans nothing.
LawAnswer diagnosed(const PseudoInverse& inverse, const LawInput& input, const LawOptions& options);

/// The answer with its twist: -gain(|u|) basis u, where u is the answer for a gain of one, its sign
/// turned (J^+ e).
LawAnswer with_velocities(LawAnswer answer, const UpToSix& u, const LawInput& input,
                          const LawOptions& options);

/// -gain (L basis)^+ e with its diagnostics: any law that has an interaction matrix of its own.
LawAnswer solved(const TaskJacobian& L, const Eigen::VectorXd& error, const LawInput& input,
                 const LawOptions& options);

}  // namespace kestrel::laws
