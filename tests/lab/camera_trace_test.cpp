#include "kestrel/lab/camera_trace.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "kestrel/geometry/rotation.hpp"
#include "kestrel/lab/lab_run.hpp"

#include "lab/lab_setup.hpp"

namespace kestrel {
namespace {

/// The trace of one step.
RunTrace trace_of(const RunStep& step) {
  return {camera_trace_columns(step.points.size()), {camera_trace_row(step, {}, {0, 0, 0})}};
}

TEST(CameraTrace, RowsHaveAValueForEachColumn) {
  const RunStep step = test::steps_of(test::benchmark_setup("S0_tutorial", Law::Cur, 1)).front();
  const RunTrace trace = trace_of(step);
  ASSERT_EQ(trace.columns.size(), trace.rows[0].size());
  const auto value = [&](const char* column) { return trace.column(column).at(0); };
  EXPECT_EQ(value("error_norm"), step.error.norm());
  EXPECT_EQ(value("x3"), step.points[3].at.x);
  EXPECT_EQ(value("z3_m"), step.points[3].depth_m);
  EXPECT_EQ(value("v3_px"), 600 * step.points[3].at.y + 240);
  EXPECT_EQ(value("e3y"), step.error[7]);
  EXPECT_EQ(value("vz_m_s"), step.twist.linear.z());
  EXPECT_EQ(value("wx_rad_s"), step.twist.angular.x());
  EXPECT_NEAR(value("tx_m"), -.242845, 1e-6);
  EXPECT_NEAR(value("tuz_rad"), -50 * M_PI / 180, 1e-12);
  EXPECT_NEAR(value("distance_m"), Eigen::Vector3d(.15, -.1, 1).norm(), 1e-12);
  EXPECT_EQ(value("rank"), 6);
  EXPECT_EQ(value("condition"), step.condition);
  EXPECT_EQ(value("s1") / value("s6"), value("condition"));
  EXPECT_EQ(value("sigma_min"), value("s6"));
  EXPECT_EQ(value("refused"), 0);
}

TEST(CameraTrace, HasNoValueWhereNothingWasInverted) {
  RunStep step = test::steps_of(test::benchmark_setup("S0_tutorial", Law::Cur, 1)).front();
  step.rank = 0;
  step.singular_values.resize(0);
  step.refusal = LawRefusal::Pose;
  RunTrace trace = trace_of(step);
  for (const char* column : {"condition", "sigma_min", "s1", "s6"}) {
    EXPECT_TRUE(std::isnan(trace.column(column).at(0))) << column;
  }
  EXPECT_EQ(trace.column("refused").at(0), double(LawRefusal::Pose));
  step.rank = 5;
  step.condition = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(std::isnan(trace_of(step).column("condition").at(0)));
}

}  // namespace
}  // namespace kestrel
