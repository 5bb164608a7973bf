#pragma once

#include <type_traits>

#include <Eigen/Geometry>

#include "kestrel/geometry/frames.hpp"
#include "kestrel/geometry/transform.hpp"

namespace kestrel {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Velocity of frame F with respect to the world, at the origin of F, expressed in F.
template <class F>
struct Twist {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();   // m/s
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();  // rad/s

  /// (vx, vy, vz, wx, wy, wz)
  Vector6d vector() const { return (Vector6d() << linear, angular).finished(); }
  static Twist from_vector(const Vector6d& v) { return {v.head<3>(), v.tail<3>()}; }
};

using CameraTwist = Twist<frame::Camera>;
using BodyTwist = Twist<frame::Body>;

/// Velocity twist matrix aVb = [R, [t]x R; 0, R] of a_from_b: v_a = aVb v_b for two frames of one
/// rigid body (ViSP: vpVelocityTwistMatrix).
Matrix6d twist_matrix(const Eigen::Matrix3d& R, const Eigen::Vector3d& t);

/// The twist of one frame of a rigid body from that of another: the only road from camera to body.
template <class To, class From, class = std::enable_if_t<frame::kRigid<To, From>>>
Twist<To> operator*(const Transform<To, From>& to_from_from, const Twist<From>& twist) {
  const Eigen::Vector3d angular = to_from_from.rotation * twist.angular;
  return {to_from_from.rotation * twist.linear + to_from_from.translation.cross(angular), angular};
}

/// A rigid motion without frames: rotation and translation (m).
struct Displacement {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

/// Motion over duration_s at a constant twist (the exponential map of SE(3)): coordinates after the
/// motion to coordinates before it.
Displacement exponential(const Vector6d& twist, double duration_s);

/// The constant twist (m, rad) that makes this motion in a unit of time: inverse of exponential,
/// turns of at most half a turn; at exactly half a turn one of the two.
Vector6d logarithm(const Displacement& motion);

/// Pose of F in W after moving for duration_s at the constant twist of F.
template <class W, class F>
Transform<W, F> moved(const Transform<W, F>& w_from_f, const Twist<F>& twist, double duration_s) {
  const Displacement step = exponential(twist.vector(), duration_s);
  return w_from_f * Transform<F, F>{step.rotation, step.translation};
}

}  // namespace kestrel
