#include "kestrel/geometry/twist.hpp"

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace kestrel {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Vector3d;

Vector6d any_twist(test::Random& random) {
  return (Vector6d() << random.vector3(2), random.vector3(1.5)).finished();
}

Matrix4d matrix(const Displacement& d) {
  Matrix4d M = Matrix4d::Identity();
  M.topLeftCorner<3, 3>() = d.rotation;
  M.topRightCorner<3, 1>() = d.translation;
  return M;
}

/// The motion by integrating M' = M [v]^ with Runge-Kutta of order four.
Matrix4d integrated(const Vector6d& v, double duration_s) {
  Matrix4d hat = Matrix4d::Zero();
  hat.topLeftCorner<3, 3>() = skew(v.tail<3>());
  hat.topRightCorner<3, 1>() = v.head<3>();
  Matrix4d M = Matrix4d::Identity();
  constexpr int kSteps = 2000;
  const double h = duration_s / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const Matrix4d k1 = M * hat;
    const Matrix4d k2 = (M + h / 2 * k1) * hat;
    const Matrix4d k3 = (M + h / 2 * k2) * hat;
    const Matrix4d k4 = (M + h * k3) * hat;
    M += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return M;
}

TEST(Twist, ExponentialIsTheIntegralOfTheMotion) {
  test::Random random("exponential");
  // Angles on both sides of where the formula changes to its series, and beyond half a turn.
  for (const double scale : {0.0, 1e-8, 1e-3, 9e-3, 1.1e-2, 0.1, 1.0, 3.0}) {
    Vector6d v = any_twist(random);
    v.tail<3>() *= scale / v.tail<3>().norm();
    // RK4 with 2000 steps: (3/2000)^4 / 120 a step at most, 1e-10 in all.
    EXPECT_LT((matrix(exponential(v, 1.3)) - integrated(v, 1.3)).norm(), 1e-9) << scale;
  }
}

TEST(Twist, ExponentialIsAOneParameterGroup) {
  test::Random random("group");
  for (int i = 0; i < 100; ++i) {
    const Vector6d v = any_twist(random);
    const double s = random.uniform(-2, 2);
    const double t = random.uniform(-2, 2);
    const Matrix4d both = matrix(exponential(v, s)) * matrix(exponential(v, t));
    EXPECT_LT((both - matrix(exponential(v, s + t))).norm(), 1e-12);
  }
}

// 1 - cos loses half its digits near zero: the series must take over before that shows. Two halves
// of a motion must be the motion to the last digits.
TEST(Twist, ExponentialOfShortTimesKeepsItsDigits) {
  test::Random random("short times");
  for (int i = 0; i < 20; ++i) {
    const Vector6d v = any_twist(random);
    for (const double t : {0.02, 0.005, 1e-3, 1e-4, 1e-6}) {
      const Matrix4d half = matrix(exponential(v, t / 2));
      const Matrix4d whole = matrix(exponential(v, t));
      EXPECT_LT((half * half - whole).topRightCorner(3, 1).norm(), 1e-15) << t;
    }
  }
}

// Angles on both sides of where the formula changes to its series, up to half a turn.
TEST(Twist, LogarithmIsTheInverseOfTheExponential) {
  test::Random random("logarithm");
  for (const double angle : {0.0, 1e-12, 1e-5, 9e-3, 1.1e-2, 0.5, 2.0, M_PI - 1e-4, M_PI - 1e-9}) {
    for (int i = 0; i < 10; ++i) {
      Vector6d v = any_twist(random);
      v.tail<3>() *= angle / v.tail<3>().norm();
      EXPECT_LT((logarithm(exponential(v, 1)) - v).norm(), 1e-13) << angle;
    }
  }
}

TEST(Twist, LogarithmOfHalfATurnMakesThatMotion) {
  test::Random random("logarithm of half a turn");
  for (int i = 0; i < 20; ++i) {
    const Vector3d u = random.rotation_vector(1).normalized();
    const Displacement half{2 * u * u.transpose() - Matrix3d::Identity(), random.vector3(2)};
    EXPECT_LT((matrix(exponential(logarithm(half), 1)) - matrix(half)).norm(), 1e-13);
  }
}

TEST(Twist, VectorRoundTrip) {
  test::Random random("twist vector");
  const Vector6d v = any_twist(random);
  EXPECT_EQ(CameraTwist::from_vector(v).vector(), v);
  EXPECT_EQ(CameraTwist::from_vector(v).linear, v.head<3>());
}

TEST(Twist, MatrixAndOperatorAgree) {
  test::Random random("twist matrix");
  for (int i = 0; i < 50; ++i) {
    const Mount mount{rotation_from_vector(random.rotation_vector(M_PI)), random.vector3(1)};
    const Vector6d v = any_twist(random);
    const Vector6d by_matrix = twist_matrix(mount.rotation, mount.translation) * v;
    EXPECT_LT(((mount * CameraTwist::from_vector(v)).vector() - by_matrix).norm(), 1e-14);
  }
}

/// Velocity of a moving frame from two of its poses around an instant, in the frame itself.
template <class F>
Vector6d measured(const Transform<frame::World, F>& before, const Transform<frame::World, F>& after,
                  double duration_s) {
  const Matrix3d R = before.rotation;
  Vector6d v;
  v << R.transpose() * (after.translation - before.translation),
      rotation_vector(R.transpose() * after.rotation);
  return v / duration_s;
}

// The mount carries a twist over as the poses do: move the camera for an instant, and see how the
// helicopter it is bolted to has moved. Nothing but poses is composed.
TEST(Twist, MountCarriesItAsThePosesMove) {
  test::Random random("adjoint");
  for (int i = 0; i < 100; ++i) {
    const Mount body_from_camera{rotation_from_vector(random.rotation_vector(M_PI)),
                                 random.vector3(1)};
    const Transform<frame::World, frame::Camera> world_from_camera{
        rotation_from_vector(random.rotation_vector(M_PI)), random.vector3(5)};
    const CameraTwist twist = CameraTwist::from_vector(any_twist(random));
    constexpr double kInstant = 1e-6;
    const auto camera_from_body = body_from_camera.inverse();
    const auto before = world_from_camera * camera_from_body;
    const auto after = moved(world_from_camera, twist, kInstant) * camera_from_body;
    // Forward difference: error about |omega|^2 |v| kInstant, rounding 1e-15 / kInstant.
    const Vector6d error = measured(before, after, kInstant) - (body_from_camera * twist).vector();
    EXPECT_LT(error.norm(), 5e-5);
  }
}

// The textbook case by hand: a camera 1 m ahead of a helicopter that yaws to the right at 1 rad/s
// sweeps to the right at 1 m/s.
TEST(Twist, LeverArmOfAYaw) {
  Transform<frame::Camera, frame::Body> camera_from_body;  // same axes, 1 m ahead
  camera_from_body.translation = {-1, 0, 0};
  const BodyTwist yaw{{0, 0, 0}, {0, 0, 1}};
  const CameraTwist seen = camera_from_body * yaw;
  EXPECT_EQ(seen.linear, Vector3d(0, 1, 0));
  EXPECT_EQ(seen.angular, Vector3d(0, 0, 1));
}

TEST(Twist, MovedPosesFollowTheTwistInTheMovingFrame) {
  Transform<frame::World, frame::Body> pose{rotation_from_rpy(0, 0, M_PI / 2), {1, 2, 3}};
  const auto next = moved(pose, BodyTwist{{1, 0, 0}, {0, 0, 0}}, 2);  // heading east, forward
  EXPECT_LT((next.translation - Vector3d(1, 4, 3)).norm(), 1e-14);
  EXPECT_LT((next.rotation - pose.rotation).norm(), 1e-14);
}

}  // namespace
}  // namespace kestrel
