#include "pseudo_inverse.hpp"

#include <utility>

namespace kestrel::laws {
namespace {

/// As many rows as columns at least: rows of zeros say nothing.
TaskJacobian upright(const TaskJacobian& J) {
  if (J.rows() >= J.cols()) return J;
  TaskJacobian padded = TaskJacobian::Zero(J.cols(), J.cols());
  padded.topRows(J.rows()) = J;
  return padded;
}

}  // namespace

PseudoInverse::PseudoInverse(const TaskJacobian& J, double rank_tolerance) : qr_(upright(J)) {
  const Eigen::Index n = J.cols();
  const Square R = qr_.matrixQR().topRows(n).triangularView<Eigen::Upper>();
  svd_.compute(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  svd_.setThreshold(rank_tolerance);
}

UpToSix PseudoInverse::operator*(const Eigen::VectorXd& e) const {
  Eigen::VectorXd turned = Eigen::VectorXd::Zero(qr_.rows());
  turned.head(e.size()) = e;
  turned.applyOnTheLeft(qr_.householderQ().adjoint());
  const UpToSix values = svd_.singularValues();
  UpToSix along = svd_.matrixU().transpose() * turned.head(values.size());
  const Eigen::Index kept = svd_.rank();
  along.head(kept).array() /= values.head(kept).array();
  along.tail(values.size() - kept).setZero();
  return svd_.matrixV() * along;
}

double PseudoInverse::condition() const {
  const UpToSix values = svd_.singularValues();
  return values[0] / values[values.size() - 1];
}

TwistBasis basis_of(const LawInput& input) {
  if (input.basis.cols() == 0) return Matrix6d::Identity();
  return input.basis;
}

TaskJacobian in_basis(const TaskJacobian& L, const LawInput& input) {
  if (input.basis.cols() == 0) return L;
  return L * input.basis;
}

LawAnswer diagnosed(const PseudoInverse& inverse, const LawInput& input,
                    const LawOptions& options) {
  LawAnswer answer;
  const UpToSix values = inverse.singular_values();
  answer.singular_values = values;
  answer.rank = inverse.rank();
  answer.condition = inverse.condition();
  answer.smallest_singular_value = values[values.size() - 1];
  if (input.basis.cols() > 0 && input.basis.isZero(0)) {
    answer.refusal = LawRefusal::Unreachable;
  } else if (!values.allFinite() || !(values[0] > 0) || answer.condition > options.max_condition) {
    answer.refusal = LawRefusal::Singular;
  }
  return answer;
}

LawAnswer with_velocities(LawAnswer answer, const UpToSix& u, const LawInput& input,
                          const LawOptions& options) {
  answer.gain_per_s = options.gain.at(u.lpNorm<Eigen::Infinity>());
  const UpToSix velocities = -answer.gain_per_s * u;
  answer.twist = CameraTwist::from_vector(
      input.basis.cols() == 0 ? Vector6d(velocities) : Vector6d(input.basis * velocities));
  return answer;
}

LawAnswer solved(const TaskJacobian& L, const Eigen::VectorXd& error, const LawInput& input,
                 const LawOptions& options) {
  const PseudoInverse inverse(in_basis(L, input), options.rank_tolerance);
  LawAnswer answer = diagnosed(inverse, input, options);
  answer.error = error;
  if (answer.refusal != LawRefusal::None) return answer;
  return with_velocities(std::move(answer), inverse * error, input, options);
}

}  // namespace kestrel::laws
