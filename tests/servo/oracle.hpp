#pragma once

#include <cmath>
#include <vector>

#include <Eigen/Dense>

#include "kestrel/geometry/transform.hpp"
#include "kestrel/geometry/twist.hpp"
#include "kestrel/servo/servo.hpp"

/// The law written again from its papers, in long double, sharing nothing with ViSP or the code
/// under test: its own rounding is 2000 times smaller.
namespace kestrel::test {

using Real = long double;
using MatrixXr = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using VectorXr = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using Vector3r = Eigen::Matrix<Real, 3, 1>;
using Matrix3r = Eigen::Matrix<Real, 3, 3>;

/// Chaumette & Hutchinson 2006, eq. (11).
inline MatrixXr oracle_interaction(const std::vector<Feature>& points) {
  MatrixXr L(2 * points.size(), 6);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Real x = points[i].at.x;
    const Real y = points[i].at.y;
    const Real Z = points[i].depth_m;
    L.row(Eigen::Index(2 * i)) << -1 / Z, 0, x / Z, x * y, -(1 + x * x), y;
    L.row(Eigen::Index(2 * i + 1)) << 0, -1 / Z, y / Z, 1 + y * y, -x * y, -x;
  }
  return L;
}

/// The camera's twist for a unit of each of the body's six velocities, from the velocity of a point
/// of a rigid body, v + w x p, and a change of axes.
inline MatrixXr oracle_twist_matrix(const Mount& body_from_camera) {
  const Matrix3r axes = body_from_camera.rotation.cast<Real>().transpose();
  const Vector3r p = body_from_camera.translation.cast<Real>();
  MatrixXr V = MatrixXr::Zero(6, 6);
  for (int i = 0; i < 3; ++i) {
    const Vector3r unit = Vector3r::Unit(i);
    V.block<3, 1>(0, i) = axes * unit;
    V.block<3, 1>(0, 3 + i) = axes * unit.cross(p);
    V.block<3, 1>(3, 3 + i) = axes * unit;
  }
  return V;
}

inline std::vector<int> oracle_rows(Freedom freedom) {
  if (freedom == Freedom::Six) return {0, 1, 2, 3, 4, 5};
  if (freedom == Freedom::Four) return {0, 1, 2, 5};
  return {0, 1, 2};
}

/// Columns of cVb that the law may use.
inline MatrixXr oracle_basis(const Mount& body_from_camera, Freedom freedom) {
  const MatrixXr V = oracle_twist_matrix(body_from_camera);
  const std::vector<int> rows = oracle_rows(freedom);
  MatrixXr basis(6, rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) basis.col(Eigen::Index(i)) = V.col(rows[i]);
  return basis;
}

struct OracleAnswer {
  Vector6d twist;
  double condition = 0;
};

/// v_c = B u, u the least-squares solution of (L B) u = -gain e by QR.
inline OracleAnswer oracle_servo(const std::vector<Feature>& measured,
                                 const std::vector<Feature>& desired, const Mount& body_from_camera,
                                 const ServoOptions& options) {
  const MatrixXr now = oracle_interaction(measured);
  const MatrixXr goal = oracle_interaction(desired);
  MatrixXr L = (now + goal) / 2;
  if (options.law == Law::Cur) L = now;
  if (options.law == Law::Des) L = goal;
  VectorXr e(2 * measured.size());
  for (std::size_t i = 0; i < measured.size(); ++i) {
    e[Eigen::Index(2 * i)] = Real(measured[i].at.x) - Real(desired[i].at.x);
    e[Eigen::Index(2 * i + 1)] = Real(measured[i].at.y) - Real(desired[i].at.y);
  }
  const MatrixXr B = oracle_basis(body_from_camera, options.freedom);
  const MatrixXr J = L * B;
  const VectorXr u = J.colPivHouseholderQr().solve(-Real(options.gain_per_s) * e);
  const VectorXr values = Eigen::JacobiSVD<MatrixXr>(J).singularValues();
  return {(B * u).cast<double>(), double(values[0] / values[values.size() - 1])};
}

/// A frame carried along by a small first-order step of its own twist, the axes made a rotation
/// again. Poses only.
template <class W, class F>
Transform<W, F> nudged(const Transform<W, F>& pose, const Twist<F>& twist, double duration_s) {
  const Eigen::Vector3d turn = twist.angular * duration_s;
  Eigen::Matrix3d step = Eigen::Matrix3d::Identity();
  if (turn.norm() > 0) {
    step = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  }
  return {pose.rotation * step, pose.translation + pose.rotation * twist.linear * duration_s};
}

/// s = (x0 y0 x1 y1 ...).
inline Eigen::VectorXd stacked(const std::vector<Feature>& points) {
  Eigen::VectorXd s(2 * points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    s[Eigen::Index(2 * i)] = points[i].at.x;
    s[Eigen::Index(2 * i + 1)] = points[i].at.y;
  }
  return s;
}

/// Corners of a square target of this half size, m.
inline std::array<Eigen::Vector3d, 4> square(double half) {
  return {{{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}}};
}

/// Pose from a translation (m) and a rotation vector (degrees).
inline TargetPose pose_of(const Eigen::Vector3d& t, const Eigen::Vector3d& theta_u_deg) {
  return {rotation_from_vector(theta_u_deg * M_PI / 180), t};
}

/// A camera looking forward, and one looking down with its top towards the nose.
inline Mount forward_mount(const Eigen::Vector3d& at) {
  return {(Eigen::Matrix3d() << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished(), at};
}
inline Mount down_mount(const Eigen::Vector3d& at) {
  return {(Eigen::Matrix3d() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished(), at};
}

}  // namespace kestrel::test
