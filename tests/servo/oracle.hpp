#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

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
MatrixXr oracle_interaction(const std::vector<Feature>& points);

/// The camera's twist for a unit of each of the body's six velocities, from the velocity of a point
/// of a rigid body, v + w x p, and a change of axes.
MatrixXr oracle_twist_matrix(const Mount& body_from_camera);

std::vector<int> oracle_rows(Freedom freedom);

/// Columns of cVb that the law may use.
MatrixXr oracle_basis(const Mount& body_from_camera, Freedom freedom);

struct OracleAnswer {
  Vector6d twist;
  double condition = 0;
};

/// v_c = B u, u the least-squares solution of (L B) u = -gain e by QR.
OracleAnswer oracle_servo(const std::vector<Feature>& measured, const std::vector<Feature>& desired,
                          const Mount& body_from_camera, const ServoOptions& options);

/// The u that brings J u nearest to e, by QR.
VectorXr solved(const MatrixXr& J, const VectorXr& e);

/// Largest first.
VectorXr singular_values(const MatrixXr& M);
Eigen::VectorXd singular_values(const Eigen::MatrixXd& M);

/// The u that brings M u nearest to e, leaving alone the directions whose singular value is below
/// the tolerance times the largest.
Eigen::VectorXd solved(const Eigen::MatrixXd& M, const Eigen::VectorXd& e,
                       double tolerance = 1e-15);

/// Real parts of the eigenvalues, smallest first.
Eigen::VectorXd modes(const Eigen::MatrixXd& M);

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
Eigen::VectorXd stacked(const std::vector<Feature>& points);

/// Corners of a square target of this half size, m.
std::array<Eigen::Vector3d, 4> square(double half);

/// Pose from a translation (m) and a rotation vector (degrees).
TargetPose pose_of(const Eigen::Vector3d& t, const Eigen::Vector3d& theta_u_deg);

/// A camera looking forward, and one looking down with its top towards the nose.
Mount forward_mount(const Eigen::Vector3d& at);
Mount down_mount(const Eigen::Vector3d& at);

}  // namespace kestrel::test
