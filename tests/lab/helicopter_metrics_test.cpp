#include "kestrel/lab/helicopter_metrics.hpp"

#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

constexpr double kFrame_s = kHelicopterFrame_s;

/// From 4 m south straight to the goal, 0.5 m a frame, and 0.3 m beyond it and back.
std::vector<HelicopterStep> made_up() {
  std::vector<HelicopterStep> steps;
  for (const double north_m :
       {-4.0, -3.5, -3.0, -2.5, -2.0, -1.5, -1.0, -0.5, 0.3, 0.05, 0.0, 0.0}) {
    HelicopterStep step;
    step.frame.step = int(steps.size());
    step.frame.time_s = double(steps.size()) * kFrame_s;
    step.frame.points = {{{0, 0}, 5}, {{0.1, 0}, 5}, {{0, 0.1}, 5}};
    step.position_error_m = {north_m, 0, 0};
    step.error_norm = std::abs(north_m) / 10;
    step.wanted = step.sent = {1, 0, 0, -0.1};
    steps.push_back(step);
  }
  steps[3].heading_error_rad = 0.05;
  return steps;
}

HelicopterMetrics metrics_of(const std::vector<HelicopterStep>& steps) {
  HelicopterMeter meter(HelicopterSetup{});
  for (const HelicopterStep& step : steps) meter.add(step);
  return meter.metrics();
}

TEST(HelicopterMetrics, SettledIsAfterTheLastBadFrame) {
  std::vector<HelicopterStep> steps = made_up();
  const HelicopterMetrics m = metrics_of(steps);
  EXPECT_NEAR(m.settle_position_s.value(), 9 * kFrame_s, 1e-12);
  EXPECT_NEAR(m.settle_heading_s.value(), 4 * kFrame_s, 1e-12);
  EXPECT_NEAR(m.settle_s.value(), 9 * kFrame_s, 1e-12);
  steps.back().heading_error_rad = -0.05;
  EXPECT_FALSE(metrics_of(steps).settle_s);
  EXPECT_TRUE(metrics_of(steps).settle_position_s);
  EXPECT_NEAR(metrics_of(steps).final_heading_rad, 0.05, 1e-15);
}

TEST(HelicopterMetrics, PathRatioAndOvershootAreOfTheWayFlown) {
  const HelicopterMetrics m = metrics_of(made_up());
  EXPECT_NEAR(m.path_m, 4.6, 1e-12);
  EXPECT_NEAR(m.path_ratio.value(), 1.15, 1e-12);
  EXPECT_NEAR(m.overshoot_m, 0.3, 1e-12);
  EXPECT_EQ(m.final_position_m, 0);
}

TEST(HelicopterMetrics, IntegralsAreSumsOverFrames) {
  std::vector<HelicopterStep> steps = made_up();
  steps[1].saturated = true;
  steps[2].refusal = LawRefusal::Depth;
  steps[3].seen = steps[4].seen = false;
  const HelicopterMetrics m = metrics_of(steps);
  EXPECT_NEAR(m.position_iae_m_s, 18.35 * kFrame_s, 1e-12);
  EXPECT_NEAR(m.iae_s, 1.835 * kFrame_s, 1e-12);
  double squares = 0;
  double by_time = 0;
  for (const HelicopterStep& step : steps) {
    squares += step.error_norm * step.error_norm;
    by_time += step.frame.time_s * step.error_norm;
  }
  EXPECT_NEAR(m.ise_s, squares * kFrame_s, 1e-12);
  EXPECT_NEAR(m.itae_s2, by_time * kFrame_s, 1e-12);
  EXPECT_NEAR(m.effort_m, 12 * kFrame_s, 1e-12);
  EXPECT_NEAR(m.yaw_effort_rad, 1.2 * kFrame_s, 1e-12);
  EXPECT_NEAR(m.saturated_s, kFrame_s, 1e-15);
  EXPECT_NEAR(m.refused_s, kFrame_s, 1e-15);
  EXPECT_NEAR(m.unseen_s, 2 * kFrame_s, 1e-15);
  EXPECT_EQ(m.largest_speed_m_s, 1);
  EXPECT_EQ(m.largest_yaw_rate_rad_s, 0.1);
}

TEST(HelicopterMetrics, SteadyIsTheLastThird) {
  std::vector<HelicopterStep> steps = made_up();
  for (std::size_t i = 8; i < 12; ++i) steps[i].wanted.right_m_s = i % 2 == 0 ? 0.4 : -0.2;
  const HelicopterMetrics m = metrics_of(steps);
  EXPECT_NEAR(m.steady_position_rms_m, std::sqrt((0.09 + 0.0025) / 4), 1e-12);
  EXPECT_NEAR(m.steady_right_std_m_s, 0.3, 1e-12);
  EXPECT_NEAR(m.steady_forward_std_m_s, 0, 1e-12);
}

TEST(HelicopterMetrics, MarginIsOfThePointNearestToTheBorder) {
  std::vector<HelicopterStep> steps = made_up();
  EXPECT_NEAR(metrics_of(steps).smallest_margin_px, 180, 1e-9);  // v = 300 of 480
  EXPECT_FALSE(metrics_of(steps).first_out_of_view_s);
  steps[5].frame.points[0].at.x = -0.6;  // u = -40
  EXPECT_NEAR(metrics_of(steps).smallest_margin_px, -40, 1e-9);
  EXPECT_NEAR(metrics_of(steps).first_out_of_view_s.value(), 5 * kFrame_s, 1e-12);
  steps[5].frame.points[0].at = {0.6, 0};  // u = 680 of 640
  EXPECT_NEAR(metrics_of(steps).smallest_margin_px, -40, 1e-9);
  steps[5].frame.points[0].at = {0, 0.45};  // v = 510 of 480
  EXPECT_NEAR(metrics_of(steps).smallest_margin_px, -30, 1e-9);
  steps[5].frame.points[0].at = {0, -0.45};
  EXPECT_NEAR(metrics_of(steps).smallest_margin_px, -30, 1e-9);
}

TEST(HelicopterMetrics, ConditionCountsWhereSomethingWasInverted) {
  std::vector<HelicopterStep> steps = made_up();
  EXPECT_FALSE(metrics_of(steps).largest_condition);
  steps[2].rank = steps[3].rank = 4;
  steps[2].condition = 50;
  steps[3].condition = 40;
  steps[2].smallest_singular_value = 0.2;
  steps[3].smallest_singular_value = 0.1;
  EXPECT_EQ(metrics_of(steps).largest_condition, 50);
  EXPECT_EQ(metrics_of(steps).smallest_singular_value, 0.1);
  steps[3].condition = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(metrics_of(steps).largest_condition);
}

TEST(HelicopterMetrics, NamesAreUniqueAndAnEmptyRunHasFigures) {
  std::set<std::string> names;
  EXPECT_EQ(metrics_of({}).smallest_margin_px, 0);
  for (const auto& [key, value] : named(metrics_of({}))) {
    EXPECT_TRUE(names.insert(key).second) << key;
    EXPECT_TRUE(!value || std::isfinite(*value)) << key;
  }
}

}  // namespace
}  // namespace kestrel
