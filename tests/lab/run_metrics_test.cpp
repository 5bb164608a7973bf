#include "kestrel/lab/run_metrics.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "kestrel/geometry/rotation.hpp"

#include "lab/lab_setup.hpp"

namespace kestrel {
namespace {

/// A step with the camera displaced by t from the goal, not turned.
RunStep step_at(const CameraSetup& setup, int k, const Eigen::Vector3d& t_m) {
  RunStep step;
  step.step = k;
  step.time_s = k / setup.conditions.rate_hz;
  step.goal_from_camera.translation = t_m;
  step.camera_from_target = step.goal_from_camera.inverse() * setup.scenario.goal;
  step.points = seen_points(step.camera_from_target, setup.scenario.points_m);
  step.error = Eigen::VectorXd::Zero(8);
  return step;
}

RunMetrics metrics_of(const CameraSetup& setup, const std::vector<RunStep>& steps) {
  RunMeter meter(setup);
  for (const RunStep& step : steps) meter.add(step);
  return meter.metrics();
}

CameraSetup two_per_second() {
  CameraSetup setup = test::benchmark_setup("S8_trans", Law::Cur, 100);
  setup.conditions.rate_hz = 2;
  return setup;
}

TEST(RunMetrics, CountsStepsAfterWhichItIsGoodForGood) {
  const CameraSetup setup = two_per_second();
  const double errors[] = {.5, 9e-4, 2e-3, 9e-4, 8e-4};
  std::vector<RunStep> steps;
  for (int k = 0; k < 5; ++k) {
    steps.push_back(step_at(setup, k, {0, 0, 0}));
    steps.back().error[3] = errors[k];
  }
  const RunMetrics metrics = metrics_of(setup, steps);
  EXPECT_EQ(metrics.k_error, 3);
  EXPECT_EQ(metrics.k_pose, 0);
  EXPECT_DOUBLE_EQ(metrics.initial_error, .5);
  EXPECT_DOUBLE_EQ(metrics.final_error, 8e-4);
  EXPECT_NEAR(metrics.iae_s, (.5 + 9e-4 + 2e-3 + 9e-4 + 8e-4) / 2, 1e-15);
  EXPECT_NEAR(metrics.ise_s, (.25 + 2 * 81e-8 + 4e-6 + 64e-8) / 2, 1e-15);
  EXPECT_NEAR(metrics.itae_s2, (.5 * 9e-4 + 1 * 2e-3 + 1.5 * 9e-4 + 2 * 8e-4) / 2, 1e-15);
  steps.back().error[3] = 1e-3;  // the threshold itself is no good
  EXPECT_FALSE(metrics_of(setup, steps).k_error);
}

TEST(RunMetrics, JudgesThePoseByBothTolerances) {
  const CameraSetup setup = two_per_second();
  std::vector<RunStep> steps{step_at(setup, 0, {0, 0, .0076}), step_at(setup, 1, {0, 0, .0074}),
                             step_at(setup, 2, {0, 0, .001})};
  EXPECT_EQ(metrics_of(setup, steps).k_pose, 1);                            // 1 % of 0.75 m
  steps[1].goal_from_camera.rotation = rotation_from_vector({0, .018, 0});  // 1.03 deg
  EXPECT_EQ(metrics_of(setup, steps).k_pose, 2);
  EXPECT_NEAR(metrics_of(setup, {steps[1]}).final_angle_rad, .018, 1e-15);
}

TEST(RunMetrics, MeasuresTheCamerasWay) {
  const CameraSetup setup = two_per_second();
  // Back by 0.2 m beyond the start, then past the goal by 0.1 m.
  const RunMetrics metrics =
      metrics_of(setup, {step_at(setup, 0, {0, 0, -.5}), step_at(setup, 1, {0, 0, -.7}),
                         step_at(setup, 2, {0, 0, .1}), step_at(setup, 3, {0, 0, 0})});
  EXPECT_NEAR(metrics.retreat_m, .2, 1e-15);
  EXPECT_NEAR(metrics.approach_m, .1, 1e-15);
  EXPECT_NEAR(metrics.path_m, 1.1, 1e-15);
  EXPECT_NEAR(*metrics.path_ratio, 2.2, 1e-14);
  EXPECT_EQ(metrics.final_position_m, 0);
  EXPECT_FALSE(metrics_of(setup, {step_at(setup, 0, {0, 0, 0})}).path_ratio);
}

TEST(RunMetrics, MeasuresImagePathsAgainstTheirChords) {
  CameraSetup setup = two_per_second();
  setup.scenario.points_m = {{0, 0, 0}};
  const auto at_pixel = [&](double u, double v) {  // of the point, from the centre
    return step_at(setup, 0, {-u * .75 / 600, -v * .75 / 600, 0});
  };
  // 60 px to the right of the goal, a detour of 20 px downwards.
  const RunMetrics metrics =
      metrics_of(setup, {at_pixel(60, 0), at_pixel(60, 20), at_pixel(0, 20), at_pixel(0, 0)});
  EXPECT_NEAR(*metrics.image_ratio, 100. / 60, 1e-12);
  EXPECT_NEAR(metrics.image_deviation_px, 20, 1e-12);
  EXPECT_NEAR(metrics.smallest_margin_px, 220, 1e-12);  // 260 of 480
  EXPECT_FALSE(metrics.first_out_of_view);
  const RunMetrics out =
      metrics_of(setup, {at_pixel(0, 0), at_pixel(0, -245), at_pixel(-330, 0), at_pixel(0, 0)});
  EXPECT_NEAR(out.smallest_margin_px, -10, 1e-12);
  EXPECT_EQ(out.first_out_of_view, 1);
  EXPECT_FALSE(out.image_ratio);  // no chord
}

TEST(RunMetrics, DeviationIsAcrossTheChordWhateverItsDirection) {
  CameraSetup setup = two_per_second();
  setup.scenario.points_m = {{0, 0, 0}};
  const auto at_pixel = [&](double u, double v) {  // of the point, from the centre
    return step_at(setup, 0, {-u * .75 / 600, -v * .75 / 600, 0});
  };
  for (const Eigen::Vector2d& start : {Eigen::Vector2d(30, 40), Eigen::Vector2d(-40, 30),
                                       Eigen::Vector2d(-30, -40), Eigen::Vector2d(40, -30)}) {
    const Eigen::Vector2d across = Eigen::Vector2d(-start.y(), start.x()) / 50;
    for (const double off_px : {10., -15.}) {
      // A quarter of the way, so that along and across the chord are not alike.
      const Eigen::Vector2d aside = .75 * start + off_px * across;
      const RunMetrics metrics = metrics_of(
          setup, {at_pixel(start.x(), start.y()), at_pixel(aside.x(), aside.y()), at_pixel(0, 0)});
      EXPECT_NEAR(metrics.image_deviation_px, std::abs(off_px), 1e-11);
    }
  }
}

TEST(RunMetrics, TheFinalAngleIsThatAboutAnyAxis) {
  const CameraSetup setup = two_per_second();
  RunStep step = step_at(setup, 0, {0, 0, 0});
  for (const Eigen::Vector3d& turn :
       {Eigen::Vector3d(.5, 0, 0), Eigen::Vector3d(0, .5, 0), Eigen::Vector3d(0, 0, .5),
        Eigen::Vector3d(.3, -.4, 1.2), Eigen::Vector3d(2, 2, -1)}) {
    step.goal_from_camera.rotation = rotation_from_vector(turn);
    EXPECT_NEAR(metrics_of(setup, {step}).final_angle_rad, turn.norm(), 1e-14);
  }
}

TEST(RunMetrics, MeasuresSpeedEffortAndSaturation) {
  const CameraSetup setup = two_per_second();
  std::vector<RunStep> steps{step_at(setup, 0, {0, 0, 0}), step_at(setup, 1, {0, 0, 0})};
  steps[0].twist = {{0, 3, 4}, {0, 0, 12}};
  steps[0].saturated = true;
  const RunMetrics metrics = metrics_of(setup, steps);
  EXPECT_EQ(metrics.max_linear_m_s, 5);
  EXPECT_EQ(metrics.max_angular_rad_s, 12);
  EXPECT_EQ(metrics.effort, 6.5);
  EXPECT_EQ(metrics.saturated_s, .5);
}

TEST(RunMetrics, KeepTheWorstMatrix) {
  const CameraSetup setup = two_per_second();
  std::vector<RunStep> steps(3, step_at(setup, 0, {0, 0, 0}));
  EXPECT_FALSE(metrics_of(setup, steps).largest_condition);
  for (std::size_t i = 0; i < 3; ++i) {
    steps[i].rank = 6;
    steps[i].condition = i == 1 ? 120 : 80;
    steps[i].smallest_singular_value = i == 2 ? .01 : .03;
  }
  EXPECT_EQ(metrics_of(setup, steps).largest_condition, 120);
  EXPECT_EQ(metrics_of(setup, steps).smallest_singular_value, .01);
  steps[1].condition = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(metrics_of(setup, steps).largest_condition);
}

TEST(RunMetrics, SteadyErrorIsThatOfTheLastThird) {
  const CameraSetup setup = two_per_second();
  std::vector<RunStep> steps;
  for (const double z : {1., 1., 1., 1., .03, .04}) {
    steps.push_back(step_at(setup, int(steps.size()), {0, 0, z}));
  }
  EXPECT_NEAR(metrics_of(setup, steps).steady_position_rms_m, .05 / std::sqrt(2), 1e-15);
}

TEST(RunMetrics, NoStepsGiveNoInfinities) {
  const RunMetrics metrics = metrics_of(two_per_second(), {});
  EXPECT_EQ(metrics.smallest_margin_px, 0);
  EXPECT_EQ(metrics.steady_position_rms_m, 0);
  EXPECT_EQ(
      metrics_of(two_per_second(), {step_at(two_per_second(), 0, {1, 0, 0})}).steady_position_rms_m,
      0);  // the last third of one step is none
}

TEST(RunMetrics, GiveStepsInSecondsToo) {
  RunMetrics metrics;
  metrics.k_error = 60;
  const auto list = named(metrics, 30);
  EXPECT_EQ(list[0].first, "k_error");
  EXPECT_EQ(list[0].second, 60);
  EXPECT_EQ(list[1].first, "t_error_s");
  EXPECT_EQ(list[1].second, 2);
  EXPECT_FALSE(list[3].second);  // t_pose_s
}

}  // namespace
}  // namespace kestrel
