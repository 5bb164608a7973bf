#include "kestrel/lab/helicopter_scenario.hpp"

#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "kestrel/geometry/rotation.hpp"

namespace kestrel {
namespace {

using Eigen::Vector3d;

TEST(HelicopterScenario, CamerasLookWhereTheyAreNamedAfter) {
  EXPECT_EQ(forward_camera().rotation * Vector3d(0, 0, 1), Vector3d(1, 0, 0));
  EXPECT_EQ(forward_camera().rotation * Vector3d(1, 0, 0), Vector3d(0, 1, 0));
  EXPECT_EQ(forward_camera().rotation * Vector3d(0, 1, 0), Vector3d(0, 0, 1));
  EXPECT_EQ(down_camera().rotation * Vector3d(0, 0, 1), Vector3d(0, 0, 1));
  EXPECT_EQ(down_camera().rotation * Vector3d(1, 0, 0), Vector3d(0, 1, 0));
  EXPECT_EQ(down_camera().rotation * Vector3d(0, 1, 0), Vector3d(-1, 0, 0));
  EXPECT_LT(rotation_defect(forward_camera().rotation), 1e-15);
  EXPECT_LT(rotation_defect(down_camera().rotation), 1e-15);
  EXPECT_EQ(down_camera({1, 2, 3}).translation, Vector3d(1, 2, 3));
}

TEST(HelicopterScenario, TheBenchmarksTargetIsAWallToTheNorth) {
  const HelicopterScenario s = helicopter_h0();
  // North 0, east and down +-0.5 m, in the benchmark's order.
  const Vector3d corners[] = {{0, -.5, -.5}, {0, .5, -.5}, {0, .5, .5}, {0, -.5, .5}};
  ASSERT_EQ(s.points_m.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT((s.world_from_target * s.points_m[i] - corners[i]).norm(), 1e-15);
  }
  const Transform<frame::World, frame::Camera> goal = s.world_from_target * s.goal.inverse();
  EXPECT_LT((goal.translation - Vector3d(-5, 0, 0)).norm(), 1e-15);
  EXPECT_LT((goal.rotation - forward_camera().rotation).norm(), 1e-15);
  EXPECT_EQ(s.start_camera_m, Vector3d(-9, 1.5, 1.0));
  EXPECT_EQ(s.start_yaw_rad, 0);
  EXPECT_NEAR(helicopter_h1().start_yaw_rad, -12 * M_PI / 180, 1e-15);
  for (const HelicopterScenario& scenario : helicopter_scenarios())
    EXPECT_NO_THROW(scenario.check());
}

TEST(HelicopterScenario, GoalHeadingIsThatOfTheBody) {
  HelicopterScenario s = helicopter_h0();
  EXPECT_NEAR(goal_heading(s), 0, 1e-15);
  s.world_from_target.rotation = rotation_from_vector({0, 0, 0.7}) * s.world_from_target.rotation;
  EXPECT_NEAR(goal_heading(s), 0.7, 1e-15);
  EXPECT_NO_THROW(s.check());
  // Above a target on the ground whose y is south, x east: north is ahead.
  s = helicopter_h0();
  s.body_from_camera = down_camera();
  s.world_from_target.rotation = down_camera().rotation;
  EXPECT_NEAR(goal_heading(s), 0, 1e-15);
  EXPECT_NO_THROW(s.check());
}

TEST(HelicopterScenario, NonsenseIsNamed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto wrong = [](const std::function<void(HelicopterScenario&)>& change) {
    HelicopterScenario s = helicopter_h0();
    change(s);
    EXPECT_THROW(s.check(), std::invalid_argument);
  };
  wrong([](auto& s) { s.points_m.clear(); });
  wrong([&](auto& s) { s.points_m[1].y() = nan; });
  wrong([](auto& s) { s.world_from_target.rotation *= 2; });
  wrong([&](auto& s) { s.target_velocity_m_s.x() = nan; });
  wrong([](auto& s) { s.body_from_camera.rotation.setZero(); });
  wrong([&](auto& s) { s.goal.translation.z() = nan; });
  wrong([](auto& s) { s.goal.rotation = rotation_from_vector({0.01, 0, 0}); });  // not level
  wrong([&](auto& s) { s.start_camera_m.x() = nan; });
  wrong([&](auto& s) { s.start_yaw_rad = nan; });
}

}  // namespace
}  // namespace kestrel
