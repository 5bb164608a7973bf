#include "kestrel/lab/law_sight.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "lab/lab_setup.hpp"

namespace kestrel {
namespace {

const Vector6d kMotion = (Vector6d() << .01, .02, .03, .004, .005, .006).finished();

/// Looks from the scenario's start.
void look(LawSight& sight, const Scenario& scenario, const Vector6d& motion) {
  sight.look(seen_points(scenario.start, scenario.points_m), scenario.start, motion);
}

TEST(LawSight, TellsTheTruthInAnIdealWorld) {
  const CameraSetup setup = test::benchmark_setup("S0_tutorial", Law::PbvsCt, 1);
  LawSight sight(setup);
  look(sight, setup.scenario, kMotion);
  const LawInput& told = sight.told();
  const std::vector<Feature> points = seen_points(setup.scenario.start, setup.scenario.points_m);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(told.measured[i].at.x, points[i].at.x);
    EXPECT_EQ(told.measured[i].depth_m, points[i].depth_m);
    EXPECT_EQ(told.desired[i].depth_m, .75);
  }
  EXPECT_FALSE(told.camera_motion);  // of the first image
  ASSERT_TRUE(told.goal_from_camera);
  EXPECT_TRUE(told.goal_from_camera->translation.isApprox(
      setup.scenario.start_in_goal().translation, 1e-14));
}

TEST(LawSight, ScalesDepthsAndTranslations) {
  CameraSetup setup = test::benchmark_setup("S0_tutorial", Law::PbvsCt, 1);
  setup.conditions.depth_factor = 2;
  LawSight sight(setup);
  look(sight, setup.scenario, kMotion);
  const LawInput& told = sight.told();
  EXPECT_EQ(told.measured[2].depth_m,
            2 * seen_points(setup.scenario.start, setup.scenario.points_m)[2].depth_m);
  EXPECT_EQ(told.desired[2].depth_m, 1.5);
  EXPECT_TRUE(told.goal_from_camera->translation.isApprox(
      2 * setup.scenario.start_in_goal().translation, 1e-14));
  EXPECT_TRUE(told.goal_from_camera->rotation.isApprox(setup.scenario.start_in_goal().rotation));
}

/// What a mis-calibrated camera tells where the law sees no error is what it was told as s*.
void expect_no_error_where_reached(const CameraSetup& setup) {
  LawSight sight(setup);
  std::vector<Feature> points(4);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto at = sight.reached().segment<2>(Eigen::Index(2 * i));
    points[i] = {{at[0], at[1]}, 1};
  }
  sight.look(points, setup.scenario.goal, Vector6d::Zero());
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(sight.told().measured[i].at.x, sight.told().desired[i].at.x, 1e-15);
    EXPECT_NEAR(sight.told().measured[i].at.y, sight.told().desired[i].at.y, 1e-15);
  }
}

TEST(LawSight, BelievesAMisCalibratedCamera) {
  CameraSetup setup = test::benchmark_setup("S0_tutorial", Law::Cur, 1);
  setup.conditions.focal_factor = 0.8;
  setup.conditions.principal_u_px = 20;
  setup.conditions.principal_v_px = -12;
  expect_no_error_where_reached(setup);
  LawSight taught(setup);
  look(taught, setup.scenario, kMotion);
  const Feature truth = seen_points(setup.scenario.start, setup.scenario.points_m)[1];
  // u = 600 x + 320 is taken for 480 x' + 340.
  EXPECT_NEAR(taught.told().measured[1].at.x, (600 * truth.at.x - 20) / 480, 1e-15);
  EXPECT_NEAR(taught.told().measured[1].at.y, (600 * truth.at.y + 12) / 480, 1e-15);
  EXPECT_NEAR(taught.reached()[0], -.1 / .75, 1e-15);
  setup.conditions.desired = Conditions::Desired::Model;
  expect_no_error_where_reached(setup);
  EXPECT_NEAR(LawSight(setup).reached()[0], -.8 * .1 / .75 + 20. / 600, 1e-15);
}

TEST(LawSight, PoseIsTheOneThatThePointsGive) {
  CameraSetup setup = test::benchmark_setup("S0_tutorial", Law::PbvsCt, 1);
  setup.conditions.focal_factor = 1.1;
  setup.conditions.desired = Conditions::Desired::Model;
  // The goal as a camera with kf sees it from kf times as far.
  setup.scenario.start = setup.scenario.goal;
  setup.scenario.start.translation.z() /= 1.1;
  LawSight sight(setup);
  look(sight, setup.scenario, kMotion);
  ASSERT_TRUE(sight.told().goal_from_camera);
  EXPECT_LT(sight.told().goal_from_camera->translation.norm(), 1e-9);  // of the iteration
}

TEST(LawSight, HomographyIsThatOfThePlane) {
  const CameraSetup setup = test::benchmark_setup("S0_tutorial", Law::Homog, 1);
  LawSight sight(setup);
  look(sight, setup.scenario, kMotion);
  ASSERT_TRUE(sight.told().camera_from_goal_homography);
  const Eigen::Matrix3d& H = *sight.told().camera_from_goal_homography;
  const Feature& goal = sight.told().desired[3];
  const Feature& seen = sight.told().measured[3];
  const Eigen::Vector3d p = H * Eigen::Vector3d(goal.at.x, goal.at.y, 1);
  EXPECT_NEAR(p.x() / p.z(), seen.at.x, 1e-12);
  EXPECT_NEAR(p.z(), seen.depth_m / goal.depth_m, 1e-12);
}

TEST(LawSight, TellsLateWhatWasSeenAndTheMotionBetween) {
  CameraSetup setup = test::benchmark_setup("S0_tutorial", Law::Broyden, 1);
  setup.conditions.delay_frames = 2;
  LawSight sight(setup);
  for (int k = 0; k < 7; ++k) {
    const double x = .01 * k;
    sight.look(std::vector<Feature>(4, Feature{{x, 0}, 1}), setup.scenario.start, k * kMotion);
    const int used = std::max(0, k - 2);
    EXPECT_EQ(sight.told().measured[0].at.x, .01 * used);
    // The motion of the step that led to the image used; none while it is still the first.
    EXPECT_EQ(sight.told().camera_motion.has_value(), used > 0) << k;
    if (used > 0) {
      EXPECT_EQ(*sight.told().camera_motion, used * kMotion);
    }
    EXPECT_DOUBLE_EQ(sight.told().time_s, k / 30.);
  }
}

TEST(LawSight, DrawsAPairForEachPointInOrder) {
  CameraSetup setup = test::benchmark_setup("S0_tutorial", Law::Cur, 1);
  setup.conditions.noise_px = 0.5;
  LawSight sight(setup);
  PixelNoise noise(42, 0.5);
  const std::vector<Feature> truth = seen_points(setup.scenario.start, setup.scenario.points_m);
  for (int k = 0; k < 3; ++k) {
    look(sight, setup.scenario, kMotion);
    for (std::size_t i = 0; i < 4; ++i) {
      const Pixel drawn = noise.next();
      EXPECT_DOUBLE_EQ(sight.told().measured[i].at.x, truth[i].at.x + drawn.u / 600);
      EXPECT_DOUBLE_EQ(sight.told().measured[i].at.y, truth[i].at.y + drawn.v / 600);
    }
  }
}

}  // namespace
}  // namespace kestrel
