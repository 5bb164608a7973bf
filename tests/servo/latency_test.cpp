#include "kestrel/servo/latency.hpp"

#include <array>
#include <limits>

#include <gtest/gtest.h>

#include "kestrel/geometry/rotation.hpp"

#include "support/random.hpp"

namespace kestrel {
namespace {

std::array<Eigen::Vector3d, 4> square() {
  using Eigen::Vector3d;
  return {Vector3d(-0.5, -0.5, 0), Vector3d(0.5, -0.5, 0), Vector3d(0.5, 0.5, 0),
          Vector3d(-0.5, 0.5, 0)};
}

TargetPose random_pose(test::Random& random) {
  return {rotation_from_vector(random.rotation_vector(0.4)),
          Eigen::Vector3d(0, 0, 5) + random.vector3(1)};
}

void expect_near(const std::vector<Feature>& a, const std::vector<Feature>& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(a[i].at.x, b[i].at.x, tolerance);
    EXPECT_NEAR(a[i].at.y, b[i].at.y, tolerance);
    EXPECT_NEAR(a[i].depth_m, b[i].depth_m, tolerance);
  }
}

TEST(Latency, PredictedAreTheFeaturesOfTheMovedCamera) {
  test::Random random("moved");
  for (int i = 0; i < 20; ++i) {
    const TargetPose then = random_pose(random);
    const TargetPose now = random_pose(random);
    const CameraMotion now_from_then = now * then.inverse();
    expect_near(predicted(features(then, square()), now_from_then), features(now, square()),
                1e-13);  // rounding
  }
}

TEST(Latency, AreaGivesTheDepthOfAParallelTargetTurnedInItsPlane) {
  test::Random random("parallel");
  const std::vector<Feature> goal = features({Eigen::Matrix3d::Identity(), {0, 0, 5}}, square());
  for (int i = 0; i < 20; ++i) {
    TargetPose pose = random_pose(random);
    pose.rotation = rotation_from_vector({0, 0, random.uniform(-3, 3)});
    std::vector<Feature> seen = features(pose, square());
    for (Feature& f : seen) f.depth_m = 1;  // not looked at
    for (const Feature& f : with_area_depth(seen, goal)) {
      EXPECT_NEAR(f.depth_m, pose.translation.z(), 1e-12);
    }
  }
}

TEST(Latency, AreaDepthScalesWithTheGoalsDepth) {
  std::vector<Feature> goal = features({Eigen::Matrix3d::Identity(), {0, 0, 5}}, square());
  const std::vector<Feature> seen = features({Eigen::Matrix3d::Identity(), {0, 0, 7}}, square());
  for (Feature& f : goal) f.depth_m *= 2;
  EXPECT_NEAR(with_area_depth(seen, goal)[0].depth_m, 14, 1e-12);
}

TEST(Latency, NoAreaNoDepth) {
  const std::vector<Feature> goal = features({Eigen::Matrix3d::Identity(), {0, 0, 5}}, square());
  EXPECT_TRUE(with_area_depth({}, {}).empty());
  EXPECT_TRUE(with_area_depth({goal[0], goal[1]}, {goal[0], goal[1]}).empty());
  EXPECT_TRUE(with_area_depth({goal[0], goal[1], goal[2]}, goal).empty());
  EXPECT_TRUE(with_area_depth({goal[0], goal[0], goal[0], goal[0]}, goal).empty());
  EXPECT_TRUE(with_area_depth(goal, {goal[0], goal[0], goal[0], goal[0]}).empty());
  std::vector<Feature> bad = goal;
  bad[2].at.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(with_area_depth(bad, goal).empty());
}

}  // namespace
}  // namespace kestrel
