#include "kestrel/servo/interaction.hpp"

#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "servo/oracle.hpp"
#include "support/random.hpp"

namespace kestrel {
namespace {

std::vector<Feature> random_points(test::Random& random, int count) {
  std::vector<Feature> points;
  for (int i = 0; i < count; ++i) {
    points.push_back(
        {{random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7)}, random.uniform(0.3, 10)});
  }
  return points;
}

TEST(InteractionMatrix, IsEquation11) {
  test::Random random("interaction");
  for (int i = 0; i < 200; ++i) {
    const auto points = random_points(random, random.integer(1, 8));
    const Eigen::MatrixXd expected = test::oracle_interaction(points).cast<double>();
    const Eigen::MatrixXd L = interaction_matrix(points);
    ASSERT_EQ(L.rows(), expected.rows());
    EXPECT_LT((L - expected).norm(), 1e-15 * expected.norm());
  }
}

// ds/dt of points that stand still, measured on a camera that moves along each axis for an instant.
TEST(InteractionMatrix, IsTheRateOfTheProjection) {
  test::Random random("interaction rate");
  const double h = 1e-5;
  for (int i = 0; i < 50; ++i) {
    const auto points = test::square(0.5);
    const TargetPose pose{rotation_from_vector(random.rotation_vector(0.6)),
                          random.vector3(0.5) + Eigen::Vector3d(0, 0, 3)};
    const auto seen_after = [&](const CameraTwist& twist, double t) {
      return test::stacked(features(moved(pose.inverse(), twist, t).inverse(), points));
    };
    const Eigen::MatrixXd L = interaction_matrix(features(pose, points));
    for (int k = 0; k < 6; ++k) {
      const CameraTwist twist = CameraTwist::from_vector(Vector6d::Unit(k));
      const Eigen::VectorXd rate = (seen_after(twist, h) - seen_after(twist, -h)) / (2 * h);
      // Third derivatives of order 10: h^2 * 10 / 6; rounding 1e-16 / h.
      EXPECT_LT((rate - L.col(k)).norm(), 2e-9) << "column " << k;
    }
  }
}

TEST(InteractionMatrix, RefusesPointsThatNoCameraSees) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(interaction_matrix({}).rows(), 0);
  EXPECT_NO_THROW(interaction_matrix({{{0.1, 0.1}, 1e-6}}));
  for (const double depth : {0.0, -0.0, 9e-7, -1.0, nan, inf, -inf}) {
    EXPECT_THROW(interaction_matrix({{{0.1, 0.1}, depth}}), std::invalid_argument) << depth;
  }
  EXPECT_THROW(interaction_matrix({{{nan, 0.1}, 1}}), std::invalid_argument);
  EXPECT_THROW(interaction_matrix({{{0.1, inf}, 1}}), std::invalid_argument);
}

// ViSP prints about what it refuses; a run's standard output is data.
TEST(InteractionMatrix, IsSilent) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  for (const double depth : {1.0, 0.0, -1.0, 1e-7}) {
    try {
      interaction_matrix({{{0.1, 0.1}, depth}});
    } catch (const std::invalid_argument&) {
      continue;
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace kestrel
