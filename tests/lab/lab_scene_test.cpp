#include "kestrel/lab/lab_scene.hpp"

#include <gtest/gtest.h>

#include "kestrel/lab/benchmark.hpp"

namespace kestrel {
namespace {

TEST(SceneOf, IsInTheCameraAtItsGoal) {
  const Scenario& s8 = benchmark_scenarios().at(8);  // starts at (.5, -.3, -.75), not turned
  const LabScene scene = scene_of(s8, {});
  EXPECT_EQ(scene.scenario, s8.name);
  EXPECT_LT((scene.start.origin_m - Eigen::Vector3d(.5, -.3, -.75)).norm(), 1e-12);
  EXPECT_LT((scene.start.axes - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  ASSERT_EQ(scene.points_m.size(), 4u);
  EXPECT_LT((scene.points_m[0] - Eigen::Vector3d(-.1, -.1, .75)).norm(), 1e-12);
  EXPECT_NEAR(scene.goal_px[0].u, 320 - 600 * .1 / .75, 1e-9);
  EXPECT_NEAR(scene.goal_px[0].v, 240 - 600 * .1 / .75, 1e-9);
  EXPECT_TRUE(scene.limits.empty());
}

TEST(SceneOf, NamesTheLimitsByTheirColumns) {
  const auto limits = scene_of(benchmark_scenarios().front(), {}, CameraLimits{}).limits;
  ASSERT_EQ(limits.size(), 6u);
  EXPECT_EQ(limits[0], std::make_pair(std::string("vx_m_s"), 1.0));
  EXPECT_EQ(limits[5].first, "wz_rad_s");
}

TEST(SceneOf, AHelicopterIsInNorthEastDown) {
  const LabScene scene = scene_of(helicopter_h0(), {}, CommandLimits{});
  EXPECT_LT((scene.start.origin_m - Eigen::Vector3d(-9, 1.5, 1)).norm(), 1e-12);
  EXPECT_LT((scene.goal.origin_m - Eigen::Vector3d(-5, 0, 0)).norm(), 1e-12);
  for (const SpaceFrame& frame : {scene.start, scene.goal})  // it looks north
    EXPECT_LT((frame.axes.col(2) - Eigen::Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_LT((scene.points_m.at(0) - Eigen::Vector3d(0, -.5, -.5)).norm(), 1e-12);
  EXPECT_NEAR(scene.goal_px.at(0).u, 320 - 600 * .5 / 5, 1e-9);
  EXPECT_EQ(scene.limits.size(), 4u);
}

}  // namespace
}  // namespace kestrel
