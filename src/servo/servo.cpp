#include "kestrel/servo/servo.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include <visp3/core/vpException.h>
#include <visp3/core/vpVelocityTwistMatrix.h>
#include <visp3/vs/vpServo.h>

#include <Eigen/SVD>

#include "kestrel/geometry/rotation.hpp"

#include "visp_point.hpp"

namespace kestrel {
namespace {

/// The most by which R^T R may miss the identity: what six written digits leave.
constexpr double kRotationTolerance = 1e-6;

/// eJe, 6 x n: the columns of the body's six velocities that the law may use.
Eigen::MatrixXd body_jacobian(Freedom freedom) {
  const Matrix6d all = Matrix6d::Identity();
  switch (freedom) {
    case Freedom::Six:
      break;
    case Freedom::Four:
      return (Eigen::Matrix<double, 6, 4>() << all.leftCols<3>(), all.col(5)).finished();
    case Freedom::Three:
      return all.leftCols<3>();
  }
  return all;
}

vpServo::vpServoIteractionMatrixType visp_type(Interaction interaction) {
  switch (interaction) {
    case Interaction::Current:
      return vpServo::CURRENT;
    case Interaction::Desired:
      return vpServo::DESIRED;
    case Interaction::Mean:
      break;
  }
  return vpServo::MEAN;
}

vpMatrix to_visp(const Eigen::MatrixXd& m) {
  vpMatrix copy(unsigned(m.rows()), unsigned(m.cols()));
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    for (Eigen::Index j = 0; j < m.cols(); ++j) copy[unsigned(i)][unsigned(j)] = m(i, j);
  }
  return copy;
}

Eigen::MatrixXd from_visp(const vpMatrix& m) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(m.data, m.getRows(), m.getCols());
}

Eigen::VectorXd from_visp(const vpColVector& v) {
  return Eigen::Map<const Eigen::VectorXd>(v.data, v.getRows());
}

/// cVb of the pose cMb of the body in the camera.
vpVelocityTwistMatrix visp_twist_matrix(
    const Transform<frame::Camera, frame::Body>& camera_from_body) {
  vpHomogeneousMatrix cMb;
  for (unsigned i = 0; i < 3; ++i) {
    for (unsigned j = 0; j < 3; ++j) cMb[i][j] = camera_from_body.rotation(i, j);
    cMb[i][3] = camera_from_body.translation[i];
  }
  return vpVelocityTwistMatrix(cMb);
}

/// vpServo keeps pointers to its features and wants an explicit end; both live and end with this.
class VispTask {
 public:
  VispTask(const std::vector<Feature>& measured, const std::vector<Feature>& desired,
           const ServoOptions& options) {
    task_.setServo(vpServo::EYEINHAND_L_cVe_eJe);
    task_.setInteractionMatrixType(visp_type(options.interaction), vpServo::PSEUDO_INVERSE);
    task_.setLambda(options.gain_per_s);
    measured_.reserve(measured.size());
    desired_.reserve(desired.size());
    for (std::size_t i = 0; i < measured.size(); ++i) {
      measured_.push_back(visp_point(measured[i]));
      desired_.push_back(visp_point(desired[i]));
      task_.addFeature(measured_.back(), desired_.back());
    }
  }
  ~VispTask() { task_.kill(); }
  VispTask(const VispTask&) = delete;
  VispTask& operator=(const VispTask&) = delete;

  vpServo& operator*() { return task_; }

 private:
  std::vector<vpFeaturePoint> measured_;
  std::vector<vpFeaturePoint> desired_;
  vpServo task_;
};

/// Largest over smallest singular value; infinite or NaN when there is none to speak of.
double condition_of(const Eigen::MatrixXd& J) {
  const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXd>(J).singularValues();
  return values[0] / values[values.size() - 1];
}

/// The law, with what ViSP throws on the way.
std::optional<Servo> solve(const std::vector<Feature>& measured,
                           const std::vector<Feature>& desired, const Mount& body_from_camera,
                           const ServoOptions& options) {
  const Transform<frame::Camera, frame::Body> camera_from_body = body_from_camera.inverse();
  const Eigen::MatrixXd eJe = body_jacobian(options.freedom);
  // A new task per call: nothing is cached, above all not L*, which vpServo computes once only.
  VispTask task(measured, desired, options);
  (*task).set_cVe(visp_twist_matrix(camera_from_body));
  (*task).set_eJe(to_visp(eJe));
  const Eigen::VectorXd u = from_visp((*task).computeControlLaw());
  const Eigen::MatrixXd J = from_visp((*task).getTaskJacobian());
  if (!u.allFinite() || !J.allFinite()) return std::nullopt;
  Servo answer;
  answer.condition = condition_of(J);
  if (!(answer.condition <= kLargestCondition)) return std::nullopt;
  answer.error = from_visp((*task).getError());
  answer.twist = camera_from_body * BodyTwist::from_vector(eJe * u);
  return answer;
}

}  // namespace

void ServoOptions::check() const {
  if (std::isfinite(gain_per_s) && gain_per_s > 0) return;
  std::ostringstream message;
  message << "gain_per_s: must be positive and finite (1/s), is " << gain_per_s;
  throw std::invalid_argument(message.str());
}

std::optional<Servo> servo(const std::vector<Feature>& measured,
                           const std::vector<Feature>& desired, const Mount& body_from_camera,
                           const ServoOptions& options) {
  if (measured.size() < 3 || measured.size() != desired.size()) return std::nullopt;
  if (!are_usable(measured) || !are_usable(desired)) return std::nullopt;
  if (!std::isfinite(options.gain_per_s)) return std::nullopt;
  if (!(rotation_defect(body_from_camera.rotation) <= kRotationTolerance)) return std::nullopt;
  if (!(body_from_camera.translation.array().abs() <= kLargest).all()) return std::nullopt;
  try {
    return solve(measured, desired, body_from_camera, options);
  } catch (const vpException&) {
    return std::nullopt;
  }
}

const char* name(Interaction interaction) {
  switch (interaction) {
    case Interaction::Current:
      return "current";
    case Interaction::Desired:
      return "desired";
    case Interaction::Mean:
      return "mean";
  }
  return "unknown";
}

const char* name(Freedom freedom) {
  switch (freedom) {
    case Freedom::Six:
      return "six";
    case Freedom::Four:
      return "four";
    case Freedom::Three:
      return "three";
  }
  return "unknown";
}

}  // namespace kestrel
