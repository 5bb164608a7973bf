#include "visp_law.hpp"

#include <mutex>
#include <utility>

#include <visp3/core/vpException.h>
#include <visp3/core/vpVelocityTwistMatrix.h>
#include <visp3/vs/vpServo.h>

#include "../visp_point.hpp"
#include "laws.hpp"
#include "pseudo_inverse.hpp"

namespace kestrel::laws {
namespace {

vpServo::vpServoIteractionMatrixType visp_type(VispMatrix matrix) {
  switch (matrix) {
    case VispMatrix::Current:
      return vpServo::CURRENT;
    case VispMatrix::Desired:
      return vpServo::DESIRED;
    case VispMatrix::Mean:
      break;
  }
  return vpServo::MEAN;
}

vpMatrix to_visp(const TwistBasis& m) {
  vpMatrix copy(unsigned(m.rows()), unsigned(m.cols()));
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    for (Eigen::Index j = 0; j < m.cols(); ++j) copy[unsigned(i)][unsigned(j)] = m(i, j);
  }
  return copy;
}

TaskJacobian from_visp(const vpMatrix& m) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(m.data, m.getRows(), m.getCols());
}

Eigen::VectorXd from_visp(const vpColVector& v) {
  return Eigen::Map<const Eigen::VectorXd>(v.data, v.getRows());
}

/// vpServo keeps pointers to its features and wants an explicit end; both live and end with this.
/// A new task per call: nothing is cached, above all not L*, which vpServo computes once only.
class VispTask {
 public:
  VispTask(VispMatrix matrix, const std::vector<Feature>& seen, const LawInput& input,
           const LawOptions& options) {
    task_.setServo(vpServo::EYEINHAND_L_cVe_eJe);
    task_.setInteractionMatrixType(visp_type(matrix), vpServo::PSEUDO_INVERSE);
    task_.setPseudoInverseThreshold(options.rank_tolerance);
    task_.setLambda(1);  // the gain may depend on the answer
    seen_.reserve(seen.size());
    desired_.reserve(seen.size());
    for (std::size_t i = 0; i < seen.size(); ++i) {
      seen_.push_back(visp_point(seen[i]));
      desired_.push_back(visp_point(input.desired[i]));
      task_.addFeature(seen_.back(), desired_.back());
    }
    task_.set_cVe(vpVelocityTwistMatrix());
    task_.set_eJe(to_visp(basis_of(input)));
  }
  ~VispTask() { task_.kill(); }
  VispTask(const VispTask&) = delete;
  VispTask& operator=(const VispTask&) = delete;

  vpServo& operator*() { return task_; }

 private:
  std::vector<vpFeaturePoint> seen_;
  std::vector<vpFeaturePoint> desired_;
  vpServo task_;
};

}  // namespace

LawAnswer visp_law(VispMatrix matrix, const std::vector<Feature>& seen, const LawInput& input,
                   const LawOptions& options) {
  static std::mutex one_at_a_time;
  const std::lock_guard<std::mutex> lock(one_at_a_time);
  try {
    VispTask task(matrix, seen, input, options);
    const UpToSix u = -from_visp((*task).computeControlLaw());
    const TaskJacobian J = from_visp((*task).getTaskJacobian());
    if (!u.allFinite() || !J.allFinite()) return refused(LawRefusal::Singular);
    LawAnswer answer = diagnosed(PseudoInverse(J, options.rank_tolerance), input, options);
    answer.error = from_visp((*task).getError());
    if (answer.refusal != LawRefusal::None) return answer;
    return with_velocities(std::move(answer), u, input, options);
  } catch (const vpException&) {
    return refused(LawRefusal::Singular);
  }
}

}  // namespace kestrel::laws
