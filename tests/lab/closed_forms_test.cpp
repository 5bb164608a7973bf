// The benchmark against what mathematics and publications say of it; takes seconds.
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "kestrel/geometry/rotation.hpp"
#include "kestrel/lab/margins.hpp"
#include "kestrel/lab/order_of_accuracy.hpp"
#include "kestrel/lab/run_metrics.hpp"

#include "lab/lab_setup.hpp"

namespace kestrel {
namespace {

using test::benchmark_setup;

constexpr double kDegree = M_PI / 180;

/// A run in nearly continuous time.
CameraSetup fine_setup(const std::string& scenario, Law law, double duration_s) {
  constexpr double kRate_hz = 3000;
  CameraSetup setup = benchmark_setup(scenario, law, int(duration_s * kRate_hz));
  setup.conditions.rate_hz = kRate_hz;
  return setup;
}

/// Largest and smallest distance to the target's centre, over Z*.
std::pair<double, double> nearest_and_farthest(const CameraSetup& setup) {
  double nearest = 1e9;
  double farthest = 0;
  run_camera(setup, [&](const RunStep& step) {
    const double distance = step.camera_from_target.translation.norm() / .75;
    nearest = std::min(nearest, distance);
    farthest = std::max(farthest, distance);
  });
  return {nearest, farthest};
}

TEST(ClosedForms, CurrentMatrixRetreatsByOneOverCosine) {
  for (const auto& [scenario, angle_deg] :
       {std::pair("S2_rz45", 45), {"S3_rz90", 90}, {"S4_rz135", 135}, {"S5_rz160", 160}}) {
    const double formula = 1 / std::cos(angle_deg * kDegree / 2);
    const double farthest = nearest_and_farthest(fine_setup(scenario, Law::Cur, 5)).second;
    // The error of Euler's method at 1/3000 s: a hundredth of that at 1/30 s, which is 0.3 to 6 %.
    EXPECT_NEAR(farthest / formula, 1, 1e-3) << scenario;
  }
}

TEST(ClosedForms, DesiredMatrixApproaches) {
  // zeta' = -(1 - cos th / zeta), th' = -sin th / zeta integrated by themselves.
  for (const auto& [scenario, angle_deg, nearest] :
       {std::tuple("S2_rz45", 45, .9218), {"S3_rz90", 90, .6735}, {"S4_rz135", 135, .194}}) {
    double zeta = 1;
    double theta = angle_deg * kDegree;
    double least = 1;
    for (int k = 0; k < 100000; ++k) {
      const double dzeta = -(1 - std::cos(theta) / zeta);
      const double dtheta = -std::sin(theta) / zeta;
      zeta += 1e-4 * dzeta;
      theta += 1e-4 * dtheta;
      least = std::min(least, zeta);
    }
    EXPECT_NEAR(least, nearest, 6e-4) << scenario;
    const double of_run = nearest_and_farthest(fine_setup(scenario, Law::Des, 5)).first;
    EXPECT_NEAR(of_run, least, 2e-3) << scenario;
  }
}

TEST(ClosedForms, MeansTurnByTheirOwnLaws) {
  const double half = 90 * kDegree / 2;
  const auto half_angle = [](const RunStep& step) {
    return std::abs(rotation_vector(step.goal_from_camera.rotation).z()) / 2;
  };
  run_camera(fine_setup("S3_rz90", Law::Mean, 3), [&](const RunStep& step) {
    const double formula = std::sin(half) * std::exp(-step.time_s);
    ASSERT_NEAR(std::sin(half_angle(step)), formula, 1e-3);  // Euler at 1/3000 s
    ASSERT_LT(step.goal_from_camera.translation.norm(), 1e-9);
  });
  run_camera(fine_setup("S3_rz90", Law::Mjp, 3), [&](const RunStep& step) {
    const double formula = std::tan(half) * std::exp(-step.time_s);
    ASSERT_NEAR(std::tan(half_angle(step)), formula, 1e-3);
    ASSERT_LT(step.goal_from_camera.translation.norm(), 1e-9);
  });
}

TEST(ClosedForms, NoiseAtTheGoalIsFilteredByTheLoop) {
  // Pose deviation of 60 000 frames at 1 px: mm, then deg; those published of a run and those
  // predicted, sqrt(a / (2 - a)) |rows of L*^+| sigma / f.
  const std::array<double, 6> published{4.62, 4.57, .418, .343, .347, .0325};
  const std::array<double, 6> predicted{4.66, 4.66, .432, .350, .350, .033};
  CameraSetup setup = benchmark_setup("S0_tutorial", Law::Des, 60000);
  setup.scenario.start = setup.scenario.goal;
  setup.conditions.noise_px = 1;
  Vector6d sum = Vector6d::Zero();
  Vector6d squares = Vector6d::Zero();
  run_camera(setup, [&](const RunStep& step) {
    Vector6d pose;
    pose << 1e3 * step.goal_from_camera.translation,
        rotation_vector(step.goal_from_camera.rotation) / kDegree;
    sum += pose;
    squares += pose.cwiseAbs2();
  });
  for (Eigen::Index i = 0; i < 6; ++i) {
    const double mean = sum[i] / 60000;
    const double deviation = std::sqrt(squares[i] / 60000 - mean * mean);
    const auto at = std::size_t(i);
    // 60 000 frames, correlated over 60 of them: 2.2 % each of two estimates, twice.
    EXPECT_NEAR(deviation / published[at], 1, .06) << i;
    EXPECT_NEAR(deviation / predicted[at], 1, .045) << i;
  }
}

TEST(ClosedForms, GainLimitsWithDelay) {
  // 2 sin(pi / (2 (2 d + 1))) / T, and what was published of runs.
  const double published[] = {59.99, 29.98, 18.52, 13.33};
  for (int delay = 0; delay < 4; ++delay) {
    CameraSetup setup = benchmark_setup("S1_small", Law::Cur, 1);
    setup.conditions.delay_frames = delay;
    const double formula = 60 * std::sin(M_PI / (2 * (2 * delay + 1)));
    const double margin = gain_margin(setup, {}).value_or(0);
    // Relative: 1e-5 of the bisection, 1e-4 of the errors' size, 1e-4 of the limited steps.
    EXPECT_NEAR(margin / formula, 1, 5e-4) << delay;
    EXPECT_NEAR(margin / published[delay], 1, 2e-3) << delay;
    // Over-estimated depth takes its factor off the margin, under-estimated depth gives none.
    setup.conditions.depth_factor = 2;
    EXPECT_NEAR(gain_margin(setup, {}).value_or(0) / formula, .5, 5e-4) << delay;
    setup.conditions.depth_factor = .5;
    EXPECT_NEAR(gain_margin(setup, {}).value_or(0) / formula, 1, 5e-4) << delay;
  }
}

TEST(ClosedForms, CalibrationMovesTheGoalUnlessItWasTaught) {
  constexpr Law kLaws[] = {Law::Cur, Law::Des, Law::Mean, Law::TwoAndHalfD, Law::PbvsCt};
  const auto final_pose = [](Law law, const std::string& modifier) {
    CameraSetup setup = benchmark_setup("S0_tutorial", law, 1);
    setup.conditions = modified({}, modifier);
    return test::steps_of(setup).back().goal_from_camera;
  };
  for (const Law law : kLaws) {
    for (const auto& [factor, offset_m] :
         {std::pair("f0.8", -.1875), {"f0.9", -.0833}, {"f1.1", .0682}, {"f1.2", .1250}}) {
      const GoalFromCamera model = final_pose(law, factor + std::string("_model"));
      EXPECT_NEAR(model.translation.z(), offset_m, 6e-5) << name(law) << factor;  // printed digits
      EXPECT_NEAR(model.translation.x(), 0, 1e-6) << name(law) << factor;
      EXPECT_LT(final_pose(law, factor).translation.norm(), 1e-6) << name(law) << factor;
    }
    const GoalFromCamera shifted = final_pose(law, "u20_model");
    EXPECT_NEAR(shifted.translation.x(), -.025, 1e-6) << name(law);
    EXPECT_LT(final_pose(law, "u20").translation.norm(), 1e-6) << name(law);
  }
}

TEST(ClosedForms, OrdersOfAccuracy) {
  const auto order = [](Law law, const AccuracyOptions& options) {
    return order_of_accuracy(benchmark_setup("S0_tutorial", law, 1), options).value_or(0);
  };
  const std::pair<Law, double> published[] = {{Law::Cur, 1.995},  {Law::Des, 2.004},
                                              {Law::Mean, 2.994}, {Law::Mjp, 3.002},
                                              {Law::PmjT, 2.994}, {Law::PmjR, 1.999}};
  for (const auto& [law, slope] : published) {
    EXPECT_NEAR(order(law, {}), slope, 6e-4) << name(law);  // printed digits
  }
  AccuracyOptions straight;
  straight.ideal = IdealTwist::StraightLine;
  EXPECT_NEAR(order(Law::PmjR, straight), 2.992, 6e-4);
  AccuracyOptions coarser;
  coarser.coarse = .05;
  coarser.fine = .025;
  EXPECT_NEAR(order(Law::MeanZdes, coarser), 2.10, 6e-3);
  EXPECT_NEAR(order(Law::CurZdes, coarser), 1.94, 6e-3);
  EXPECT_NEAR(order(Law::CurZarea, coarser), 1.94, 6e-3);
}

TEST(ClosedForms, ConditionAtTheGoal) {
  CameraSetup setup = benchmark_setup("S0_tutorial", Law::Cur, 1);
  setup.scenario.start = setup.scenario.goal;
  const RunStep step = test::steps_of(setup).front();
  const double published[] = {3.354857, 3.354857, .502831, .377124, .028262, .028262};
  for (Eigen::Index i = 0; i < 6; ++i) {
    EXPECT_NEAR(step.singular_values[i], published[i], 1e-6) << i;
  }
  EXPECT_NEAR(step.condition, 118.7057, 1e-4);
}

}  // namespace
}  // namespace kestrel
