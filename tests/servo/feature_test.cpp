#include "kestrel/servo/feature.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "kestrel/geometry/attitude.hpp"
#include "kestrel/geometry/rotation.hpp"

#include "servo/oracle.hpp"
#include "support/random.hpp"

namespace kestrel {
namespace {

// Depth times (x, y, 1) is the point again: the depth is along the optical axis, not the distance.
TEST(Features, ArePointsOfTheTargetInTheCamera) {
  test::Random random("features");
  for (int i = 0; i < 100; ++i) {
    const TargetPose pose{rotation_from_vector(random.rotation_vector(1)),
                          random.vector3(0.5) + Eigen::Vector3d(0, 0, 3)};
    const auto corners = test::square(0.4);
    const std::vector<Feature> seen = features(pose, corners);
    ASSERT_EQ(seen.size(), 4u);
    for (std::size_t k = 0; k < 4; ++k) {
      const Eigen::Vector3d p = pose.rotation * corners[k] + pose.translation;
      const Eigen::Vector3d back = seen[k].depth_m * Eigen::Vector3d(seen[k].at.x, seen[k].at.y, 1);
      EXPECT_LT((back - p).norm(), 1e-14);
    }
  }
}

TEST(Features, HaveANegativeDepthBehindTheCamera) {
  const auto seen = features(test::pose_of({0, 0, -2}, {0, 0, 0}), test::square(0.1));
  for (const Feature& f : seen) EXPECT_EQ(f.depth_m, -2);
}

// The camera turned in place: the same points seen from the turned pose.
TEST(Turned, IsWhatTheTurnedCameraSees) {
  test::Random random("turned");
  for (int i = 0; i < 100; ++i) {
    const TargetPose pose{rotation_from_vector(random.rotation_vector(0.5)),
                          random.vector3(0.5) + Eigen::Vector3d(0, 0, 3)};
    const Eigen::Matrix3d R = rotation_from_vector(random.rotation_vector(0.5));
    const auto expected = features({R * pose.rotation, R * pose.translation}, test::square(0.4));
    const auto seen = turned(features(pose, test::square(0.4)), R);
    EXPECT_LT((test::stacked(seen) - test::stacked(expected)).norm(), 1e-13);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(seen[k].depth_m, expected[k].depth_m, 1e-13);
    }
  }
}

// A helicopter that only pitches and rolls about its camera: the levelled features do not move.
TEST(Turned, TakesTheAttitudeOut) {
  test::Random random("levelled");
  const Eigen::Vector3d target_in_level(5, 0.3, -0.2);
  for (int i = 0; i < 50; ++i) {
    const Attitude attitude{random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), 0};
    const Eigen::Matrix3d level_R_body =
        (Eigen::AngleAxisd(attitude.pitch, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(attitude.roll, Eigen::Vector3d::UnitX()))
            .toRotationMatrix();
    for (const Mount& mount : {test::forward_mount({0, 0, 0}), test::down_mount({0, 0, 0})}) {
      const auto seen_by = [&](const Eigen::Matrix3d& level_R_camera) {
        const Eigen::Vector3d p =
            level_R_camera.transpose() * (target_in_level + Eigen::Vector3d(0, 0, 9));
        return std::vector<Feature>{{{p.x() / p.z(), p.y() / p.z()}, p.z()}};
      };
      const auto tilted = seen_by(level_R_body * mount.rotation);
      const auto level = turned(tilted, level_camera_from_camera(mount.rotation, attitude));
      const auto expected = seen_by(mount.rotation);
      EXPECT_NEAR(level[0].at.x, expected[0].at.x, 1e-13);
      EXPECT_NEAR(level[0].at.y, expected[0].at.y, 1e-13);
      EXPECT_NEAR(level[0].depth_m, expected[0].depth_m, 1e-13);
    }
  }
}

TEST(Features, AreFiniteWhenEveryNumberIs) {
  const std::vector<Feature> good = {{{0.1, 0.2}, 1}, {{0.3, 0.4}, 2}};
  EXPECT_TRUE(is_finite(good));
  EXPECT_TRUE(is_finite(std::vector<Feature>{}));
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    auto broken = good;
    broken[1].at.x = bad;
    EXPECT_FALSE(is_finite(broken));
    broken = good;
    broken[0].at.y = -bad;
    EXPECT_FALSE(is_finite(broken));
    broken = good;
    broken[1].depth_m = bad;
    EXPECT_FALSE(is_finite(broken));
  }
}

}  // namespace
}  // namespace kestrel
