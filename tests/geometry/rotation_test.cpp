#include "kestrel/geometry/rotation.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/random.hpp"

namespace kestrel {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kRounding = 1e-14;
const double kNan = std::numeric_limits<double>::quiet_NaN();

/// exp([theta_u]x) by its power series: no trigonometry in common with Rodrigues' formula.
Matrix3d series(const Vector3d& theta_u) {
  Matrix3d sum = Matrix3d::Identity();
  Matrix3d term = Matrix3d::Identity();
  for (int n = 1; n < 40; ++n) {
    term = (term * skew(theta_u) / n).eval();
    sum += term;
  }
  return sum;
}

TEST(Rotation, SkewIsTheCrossProduct) {
  test::Random random("skew");
  for (int i = 0; i < 20; ++i) {
    const Vector3d v = random.vector3(3);
    const Vector3d w = random.vector3(3);
    EXPECT_LT((skew(v) * w - v.cross(w)).norm(), kRounding);
    EXPECT_EQ(skew(v), -skew(v).transpose());
  }
}

TEST(Rotation, OfAVectorIsTheExponentialOfItsSkew) {
  test::Random random("rodrigues");
  for (const double size : {0.0, 1e-300, 1e-12, 1e-5, 0.1, 1.0, 3.0, M_PI, 6.0}) {
    const Vector3d theta_u = size * random.rotation_vector(1).normalized();
    // Terms of the series reach 6^6/6! = 65, so it keeps two digits less than Rodrigues' formula.
    EXPECT_LT((rotation_from_vector(theta_u) - series(theta_u)).norm(), 100 * kRounding) << size;
    EXPECT_LT(rotation_defect(rotation_from_vector(theta_u)), kRounding);
  }
}

TEST(Rotation, VectorInvertsRotationUpToPi) {
  test::Random random("rotation vector");
  for (const double angle : {0.0, 1e-15, 1e-9, 1e-4, 0.5, 1.5, 3.0, M_PI - 1e-4, M_PI - 1e-8}) {
    for (int i = 0; i < 20; ++i) {
      const Vector3d theta_u = angle * random.rotation_vector(1).normalized();
      const Vector3d back = rotation_vector(rotation_from_vector(theta_u));
      EXPECT_LT((back - theta_u).norm(), 10 * kRounding) << angle;
    }
  }
}

TEST(Rotation, VectorOfAHalfTurnIsEitherAxis) {
  test::Random random("half turn");
  for (int i = 0; i < 20; ++i) {
    const Vector3d theta_u = M_PI * random.rotation_vector(1).normalized();
    const Vector3d back = rotation_vector(rotation_from_vector(theta_u));
    EXPECT_LT(std::fmin((back - theta_u).norm(), (back + theta_u).norm()), 10 * kRounding);
    EXPECT_LE(back.norm(), M_PI + kRounding);
  }
  for (const Vector3d& axis : {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1)}) {
    const Matrix3d half = 2 * axis * axis.transpose() - Matrix3d::Identity();
    EXPECT_LT((rotation_vector(half).cwiseAbs() - M_PI * axis).norm(), kRounding);
  }
}

// Signs of yaw, pitch and roll in FRD: nose right, nose up, right side down.
TEST(Rotation, RollPitchYawTurnTheAxesTheirWay) {
  const double a = 0.1;
  EXPECT_GT((rotation_from_rpy(0, 0, a) * Vector3d::UnitX()).y(), 0.09);
  EXPECT_LT((rotation_from_rpy(0, a, 0) * Vector3d::UnitX()).z(), -0.09);
  EXPECT_GT((rotation_from_rpy(a, 0, 0) * Vector3d::UnitY()).z(), 0.09);
}

TEST(Rotation, RollPitchYawIsYawOfPitchOfRoll) {
  test::Random random("rpy");
  for (int i = 0; i < 50; ++i) {
    const Vector3d a = random.vector3(3);
    const Matrix3d by_hand = rotation_from_vector({0, 0, a.z()}) *
                             rotation_from_vector({0, a.y(), 0}) *
                             rotation_from_vector({a.x(), 0, 0});
    EXPECT_LT((rotation_from_rpy(a.x(), a.y(), a.z()) - by_hand).norm(), kRounding);
  }
}

TEST(Rotation, DefectTellsScaleShearReflectionAndNan) {
  const Matrix3d R = rotation_from_vector({0.3, -0.2, 0.9});
  EXPECT_LT(rotation_defect(R), kRounding);
  EXPECT_NEAR(rotation_defect(1.01 * R), 0.0201, 1e-12);
  Matrix3d sheared = R;
  sheared.col(0) += 0.1 * R.col(1);
  EXPECT_NEAR(rotation_defect(sheared), 0.1, 1e-12);
  EXPECT_EQ(rotation_defect(-R), 2);
  EXPECT_EQ(rotation_defect(Matrix3d::Zero()), 2);
  EXPECT_EQ(rotation_defect(Matrix3d::Constant(kNan)), 2);
}

TEST(Rotation, NearestIsARotationNoOtherIsNearer) {
  test::Random random("nearest rotation");
  for (int i = 0; i < 50; ++i) {
    Matrix3d M;
    for (int k = 0; k < 9; ++k) M(k) = random.normal();  // half of them turn handedness
    const Matrix3d R = nearest_rotation(M);
    EXPECT_LT(rotation_defect(R), 10 * kRounding);
    for (int k = 0; k < 20; ++k) {
      const Matrix3d other = R * rotation_from_vector(random.rotation_vector(0.1));
      EXPECT_LE((R - M).norm(), (other - M).norm() + kRounding);
    }
  }
  const Matrix3d R = rotation_from_vector({1, 2, -1});
  EXPECT_LT((nearest_rotation(3 * R) - R).norm(), 10 * kRounding);
}

TEST(Rotation, NearestOfNanIsNan) {
  Matrix3d M = Matrix3d::Identity();
  M(1, 2) = kNan;
  EXPECT_TRUE(nearest_rotation(M).array().isNaN().all());
}

TEST(Rotation, WrappedAngleIsTheSameDirectionWithinHalfATurn) {
  test::Random random("wrap");
  for (int i = 0; i < 200; ++i) {
    const double angle = random.uniform(-50, 50);
    const double wrapped = wrap_angle(angle);
    EXPECT_GT(wrapped, -M_PI);
    EXPECT_LE(wrapped, M_PI);
    EXPECT_NEAR(std::sin(wrapped), std::sin(angle), 1e-13);
    EXPECT_NEAR(std::cos(wrapped), std::cos(angle), 1e-13);
  }
  EXPECT_EQ(wrap_angle(M_PI), M_PI);
  EXPECT_EQ(wrap_angle(-M_PI), M_PI);
  EXPECT_EQ(wrap_angle(0.25), 0.25);
  EXPECT_TRUE(std::isnan(wrap_angle(kNan)));
}

}  // namespace
}  // namespace kestrel
