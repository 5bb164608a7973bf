#include "kestrel/lab/helicopter_trace.hpp"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "kestrel/lab/lab_run.hpp"

namespace kestrel {
namespace {

HelicopterStep some_step() {
  HelicopterStep step;
  step.frame.step = 7;
  step.frame.time_s = 0.25;
  step.frame.state.position_m = {1, 2, 3};
  step.frame.state.pitch = 0.1;
  step.frame.world_from_camera.translation = {4, 5, 6};
  step.frame.points = {{{0.1, 0.2}, 5}, {{-0.1, 0}, 5}, {{0, 0}, 5}};
  step.position_error_m = {3, 4, 0};
  step.wanted = {1, 2, 3, 4};
  step.sent = {0.1, 0.2, 0.3, 0.4};
  step.refusal = LawRefusal::Depth;
  step.seen = false;
  return step;
}

RunTrace trace_of(const HelicopterStep& step) {
  return {helicopter_trace_columns(3), {helicopter_trace_row(step, {})}};
}

TEST(HelicopterTrace, EveryColumnHasItsOwnNameAndAValue) {
  const RunTrace trace = trace_of(some_step());
  const std::set<std::string> names(trace.columns.begin(), trace.columns.end());
  EXPECT_EQ(names.size(), trace.columns.size());
  EXPECT_EQ(trace.rows[0].size(), trace.columns.size());
  EXPECT_EQ(trace.columns[0], "step");
  EXPECT_EQ(trace.columns[1], "time_s");
}

TEST(HelicopterTrace, ValuesStandUnderTheirNames) {
  const RunTrace trace = trace_of(some_step());
  const auto value = [&](const char* name) {
    const std::vector<double> column = trace.column(name);
    EXPECT_EQ(column.size(), 1u) << name;
    return column.empty() ? NAN : column[0];
  };
  EXPECT_EQ(value("step"), 7);
  EXPECT_EQ(value("time_s"), 0.25);
  EXPECT_EQ(value("down_m"), 3);
  EXPECT_EQ(value("pitch_rad"), 0.1);
  EXPECT_EQ(value("camera_east_m"), 5);
  EXPECT_EQ(value("wanted_yaw_rate_rad_s"), 4);
  EXPECT_EQ(value("sent_forward_m_s"), 0.1);
  EXPECT_EQ(value("sent_down_m_s"), 0.3);
  EXPECT_NEAR(value("u0_px"), 380, 1e-12);
  EXPECT_NEAR(value("v0_px"), 360, 1e-12);
  EXPECT_NEAR(value("u1_px"), 260, 1e-12);
  EXPECT_EQ(value("position_error_m"), 5);
  EXPECT_EQ(value("seen"), 0);
  EXPECT_EQ(value("refused"), double(LawRefusal::Depth));
  EXPECT_TRUE(std::isnan(value("condition")));
}

TEST(HelicopterTrace, AConditionIsThereWhenSomethingWasInverted) {
  HelicopterStep step = some_step();
  step.rank = 4;
  step.condition = 592;
  step.smallest_singular_value = 0.01;
  EXPECT_EQ(trace_of(step).column("condition")[0], 592);
  EXPECT_EQ(trace_of(step).column("sigma_min")[0], 0.01);
  step.condition = INFINITY;
  EXPECT_TRUE(std::isnan(trace_of(step).column("condition")[0]));
}

}  // namespace
}  // namespace kestrel
