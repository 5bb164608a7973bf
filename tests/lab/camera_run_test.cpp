#include "kestrel/lab/camera_run.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "kestrel/lab/run_metrics.hpp"

#include "lab/any_setup.hpp"
#include "lab/lab_setup.hpp"
#include "support/random.hpp"

namespace kestrel {
namespace {

using test::benchmark_setup;
using test::steps_of;

TEST(CameraRun, MeetsTheTutorialsErrors) {
  // ViSP's tutorial-ibvs-4pts: gain 0.5, 40 ms, |e| after 150 steps; ten printed digits.
  const std::pair<Law, double> published[] = {
      {Law::Cur, 2.253876834e-02}, {Law::Des, 3.406660226e-02}, {Law::Mean, 2.868349185e-02}};
  for (const auto& [law, error] : published) {
    CameraSetup setup = benchmark_setup("S0_tutorial", law, 151);
    setup.conditions.gain_per_s = 0.5;
    setup.conditions.rate_hz = 25;
    const std::vector<RunStep> steps = steps_of(setup);
    ASSERT_EQ(steps.size(), 151u);
    EXPECT_NEAR(steps.front().error.norm(), .469108342, 1e-9);
    EXPECT_NEAR(steps.back().error.norm(), error, 1e-10) << name(law);
  }
}

TEST(CameraRun, FirstTwistsOfPureTranslation) {
  // Target parallel, twice as far as at the goal: factor times the displacement of 0.95 m.
  const std::pair<Law, double> published[] = {
      {Law::Cur, 1.900}, {Law::CurZdes, .950},  {Law::Des, .475},      {Law::Mean, .760},
      {Law::Mjp, 1.188}, {Law::MeanZdes, .633}, {Law::CurZarea, 1.900}};
  for (const auto& [law, speed] : published) {
    const RunStep first = steps_of(benchmark_setup("S8_trans", law, 1)).front();
    EXPECT_NEAR(first.twist.linear.norm(), speed, 6e-4) << name(law);  // three digits
    EXPECT_LT(first.twist.angular.norm(), 1e-12) << name(law);
  }
}

TEST(CameraRun, CurrentMatrixRetreatsUnderRotationAboutTheAxis) {
  const std::pair<const char*, double> published[] = {
      {"S2_rz45", .0639}, {"S3_rz90", .3223}, {"S4_rz135", 1.2704}, {"S5_rz160", 3.8843}};
  for (const auto& [scenario, retreat_m] : published) {
    const CameraSetup setup = benchmark_setup(scenario, Law::Cur, 200);
    RunMeter meter(setup);
    run_camera(setup, [&](const RunStep& step) { meter.add(step); });
    EXPECT_NEAR(meter.metrics().retreat_m, retreat_m, 6e-5) << scenario;  // four digits
  }
}

TEST(CameraRun, MeansTurnAboutTheAxisAlone) {
  const double half = 90 * M_PI / 180 / 2;
  const RunStep mean = steps_of(benchmark_setup("S3_rz90", Law::Mean, 1)).front();
  EXPECT_NEAR(std::abs(mean.twist.angular.z()), 2 * std::tan(half), 1e-12);
  const RunStep mjp = steps_of(benchmark_setup("S3_rz90", Law::Mjp, 1)).front();
  EXPECT_NEAR(std::abs(mjp.twist.angular.z()), std::sin(2 * half), 1e-12);
  for (const RunStep& step : {mean, mjp}) EXPECT_LT(step.twist.linear.norm(), 1e-12);
}

TEST(CameraRun, DepthFactorMultipliesTranslationsOnly) {
  CameraSetup setup = benchmark_setup("S0_tutorial", Law::Cur, 1);
  const RunStep right = steps_of(setup).front();
  setup.conditions.depth_factor = 2;
  const RunStep wrong = steps_of(setup).front();
  EXPECT_TRUE(wrong.twist.linear.isApprox(2 * right.twist.linear, 1e-12));
  EXPECT_TRUE(wrong.twist.angular.isApprox(right.twist.angular, 1e-12));
}

TEST(CameraRun, LimitsKeepTheDirection) {
  CameraSetup setup = benchmark_setup("S5_rz160", Law::Cur, 40);
  const RunStep free = steps_of(setup).front();
  setup.conditions.limits.emplace();
  const std::vector<RunStep> steps = steps_of(setup);
  ASSERT_TRUE(steps.front().saturated);
  const double share = steps.front().twist.linear.z() / free.twist.linear.z();
  EXPECT_LT(share, 1);
  EXPECT_TRUE(steps.front().twist.vector().isApprox(share * free.twist.vector(), 1e-12));
  for (const RunStep& step : steps) {
    EXPECT_LE(step.twist.linear.cwiseAbs().maxCoeff(), 1 + 1e-12);
    EXPECT_LE(step.twist.angular.cwiseAbs().maxCoeff(), M_PI / 2 + 1e-12);
  }
}

TEST(CameraRun, DelayedCommandIsThatOfTheImageUsed) {
  CameraSetup setup = benchmark_setup("S0_tutorial", Law::Cur, 6);
  setup.conditions.delay_frames = 3;
  const std::vector<RunStep> steps = steps_of(setup);
  for (const std::size_t k : {1u, 2u, 3u}) {
    EXPECT_EQ(steps[k].twist.vector(), steps[0].twist.vector());
  }
  CameraSetup from_there = benchmark_setup("S0_tutorial", Law::Cur, 1);
  from_there.scenario.start = steps[2].camera_from_target;
  EXPECT_TRUE(steps[5].twist.vector().isApprox(steps_of(from_there)[0].twist.vector(), 1e-12));
}

RunResult result_of(const CameraSetup& setup) {
  return run_camera(setup, [](const RunStep&) {});
}

TEST(CameraRun, NamesItsEnd) {
  EXPECT_EQ(result_of(benchmark_setup("S1_small", Law::Cur, 300)).end, RunEnd::Converged);
  EXPECT_EQ(result_of(benchmark_setup("S1_small", Law::Cur, 10)).end, RunEnd::TimedOut);
  EXPECT_EQ(result_of(benchmark_setup("S5_rz160", Law::Des, 1500)).end, RunEnd::Collision);
  EXPECT_EQ(result_of(benchmark_setup("S7_rz180", Law::Cur, 1500)).end, RunEnd::Diverged);
  CameraSetup setup = benchmark_setup("S4_rz135", Law::Cur, 300);
  setup.scenario.start.translation.x() = .45;  // near the border, and turned about the axis
  setup.rules.stops_out_of_view = true;
  EXPECT_EQ(result_of(setup).end, RunEnd::OutOfView);
  setup = benchmark_setup("S7_rz180", Law::Mjp, 300);  // L^+ e and L*^+ e cancel: it stays
  EXPECT_EQ(result_of(setup).end, RunEnd::LocalMinimum);
  setup = benchmark_setup("S1_small", Law::Cur, 1500);
  setup.rules.settled_error = 1e-3;
  const RunResult settled = result_of(setup);
  EXPECT_EQ(settled.end, RunEnd::Converged);
  EXPECT_LT(settled.steps, 300);
}

TEST(CameraRun, BadInputHoversAndIsNamed) {
  const auto refusal = [](const CameraSetup& setup) {
    const std::vector<RunStep> steps = steps_of(setup);
    for (const RunStep& step : steps) EXPECT_EQ(step.twist.vector(), Vector6d::Zero());
    const RunResult result = result_of(setup);
    EXPECT_EQ(result.end, RunEnd::Refused);
    return result.refusal;
  };
  CameraSetup setup = benchmark_setup("S1_small", Law::Cur, 5);
  setup.scenario.points_m.resize(2);
  EXPECT_EQ(refusal(setup), LawRefusal::FewPoints);
  setup = benchmark_setup("S1_small", Law::Cur, 5);
  setup.scenario.goal.translation.z() = -.75;
  EXPECT_EQ(refusal(setup), LawRefusal::Depth);
  setup = benchmark_setup("S1_small", Law::Cur, 5);
  setup.scenario.points_m = {{-.1, 0, 0}, {0, 0, 0}, {.1, 0, 0}, {.2, 0, 0}};
  setup.law.max_condition = 1e4;
  EXPECT_EQ(refusal(setup), LawRefusal::Collinear);
  setup = benchmark_setup("S1_small", Law::Cur, 5);
  setup.conditions.rate_hz = 0;
  EXPECT_THROW(result_of(setup), std::invalid_argument);
}

TEST(CameraRun, StartsBehindTheTargetAsACollision) {
  CameraSetup setup = benchmark_setup("S1_small", Law::Cur, 5);
  setup.scenario.start.translation.z() = -1;
  const std::vector<RunStep> steps = steps_of(setup);
  ASSERT_EQ(steps.size(), 1u);
  EXPECT_EQ(steps[0].twist.vector(), Vector6d::Zero());
  EXPECT_EQ(result_of(setup).end, RunEnd::Collision);
}

TEST(CameraRun, AnyWorldEndsInTimeWithFiniteSteps) {
  test::Random random("any_world");
  for (const Law law : all_laws()) {
    for (int i = 0; i < 12; ++i) {
      const CameraSetup setup = test::any_setup(random, law);
      int seen = 0;
      RunMeter meter(setup);
      const RunResult result = run_camera(setup, [&](const RunStep& step) {
        EXPECT_EQ(step.step, seen++);
        EXPECT_TRUE(step.error.allFinite() && step.twist.vector().allFinite()) << name(law);
        EXPECT_TRUE(step.goal_from_camera.rotation.allFinite()) << name(law);
        meter.add(step);
      });
      EXPECT_EQ(result.steps, seen);
      EXPECT_LE(seen, 40);
      EXPECT_EQ(result.end == RunEnd::Refused, result.refusal != LawRefusal::None) << name(law);
      for (const auto& [metric, value] : named(meter.metrics(), 30)) {
        EXPECT_TRUE(!value || std::isfinite(*value)) << name(law) << ' ' << metric;
      }
    }
  }
}

}  // namespace
}  // namespace kestrel
