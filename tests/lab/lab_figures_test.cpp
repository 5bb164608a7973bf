#include "kestrel/lab/lab_figures.hpp"

#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lab/made_up_report.hpp"
#include "support/markup_check.hpp"

namespace kestrel {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(ScenarioFigures, ShowEveryLaw) {
  const LabReport report = test::made_up_report();
  const auto figures = scenario_figures(report, "S3_rz90", "");
  ASSERT_EQ(figures.size(), 5u);
  for (const std::string& figure : figures) {
    EXPECT_EQ(test::markup_fault(figure), "");
    EXPECT_THAT(figure, HasSubstr(">cur<"));
    EXPECT_THAT(figure, HasSubstr(">a&lt;b &amp; &quot;c&quot;<"));
  }
  EXPECT_TRUE(scenario_figures(report, "S2_rz45", "kz2").empty());
}

TEST(ScenarioFigures, ALawLooksTheSameInEachPicture) {
  const LabReport report = test::made_up_report();
  for (const std::string& figure : scenario_figures(report, "S3_rz90", ""))
    EXPECT_TRUE(std::regex_search(figure, std::regex("class=\"(kl c|b)1"))) << figure;
}

TEST(ScenarioFigures, WithoutTracesAreBars) {
  LabReport report = test::made_up_report();
  report.scenes.clear();
  for (LabRun& run : report.runs) run.trace = {};
  const auto figures = scenario_figures(report, "S3_rz90", "kz2");
  ASSERT_EQ(figures.size(), 2u);
  EXPECT_THAT(figures[0], HasSubstr(">collision<"));
}

TEST(ScenarioFigures, AHelicopterHasItsOwn) {
  LabReport report;
  LabRun run = test::made_up_run("H0", "vp4");
  run.kind = RunKind::Helicopter;
  run.trace.columns[6] = "camera_north_m";
  run.trace.columns[7] = "camera_east_m";
  run.trace.columns[8] = "camera_down_m";
  run.trace.columns[9] = "position_error_m";
  run.metrics = {{"final_position_m", 0.04}};
  report.runs = {run};
  const auto figures = scenario_figures(report, "H0", "");
  ASSERT_EQ(figures.size(), 5u);
  EXPECT_THAT(figures[3], HasSubstr("Position error"));
  EXPECT_THAT(figures[4], HasSubstr(">0.04<"));
}

TEST(RetreatFigure, HasTheCurveAndTheLawsThatRetreat) {
  LabReport report = test::made_up_report();
  for (LabRun& run : report.runs)
    if (run.law != "cur") run.metrics = {{"retreat_m", 0.}};
  const std::string figure = retreat_figure(report);
  EXPECT_EQ(test::markup_fault(figure), "");
  EXPECT_THAT(figure, HasSubstr("cos("));
  EXPECT_THAT(figure, HasSubstr(">cur<"));
  EXPECT_THAT(figure, Not(HasSubstr("a&lt;b")));
  report.scenes.pop_back();
  EXPECT_EQ(retreat_figure(report), "");
}

TEST(RetreatFigure, TheCurveIsTheClosedForm) {
  // At 90 deg it is 0.75 (sqrt(2) - 1) = 0.3107 m: a law that retreats by this ends on the curve.
  LabReport report = test::made_up_report();
  for (LabRun& run : report.runs) run.metrics = {{"retreat_m", 0.3107}};
  const std::string figure = retreat_figure(report);
  const std::regex line("<path class=\"kl c\\d[^\"]*\" d=\"[^\"]*L([0-9.]+) ([0-9.]+)\"");
  std::vector<double> ends;
  for (std::sregex_iterator l(figure.begin(), figure.end(), line), end; l != end; ++l)
    ends.push_back(std::stod((*l)[2]));
  ASSERT_GE(ends.size(), 2u);
  EXPECT_NEAR(ends[0], ends[1], 0.3);  // rounding to 0.1 px, and of the angle
}

TEST(BasinFigure, IsInPercentWithItsCounts) {
  const std::string figure = basin_figure({{"cur", 150, 200, 0.68, 0.81}, {"des", 0, 0}});
  EXPECT_EQ(test::markup_fault(figure), "");
  EXPECT_THAT(figure, HasSubstr(">150/200<"));
  EXPECT_THAT(figure, HasSubstr(">80<"));  // the axis is in percent
}

TEST(MapFigure, NumbersAndEnds) {
  LabMap map;
  map.law = "cur";
  map.x = {0.5, 2};
  map.y = {0};
  map.cells = {{{120., RunEnd::Converged}, {std::nullopt, RunEnd::LocalMinimum}}};
  const std::string figure = map_figure(map);
  EXPECT_EQ(test::markup_fault(figure), "");
  EXPECT_THAT(figure, HasSubstr(">120<"));
  EXPECT_THAT(figure, HasSubstr("local minimum"));
}

TEST(OrderFigure, WritesThreeDecimals) {
  EXPECT_THAT(order_figure({{"mean", 2.9941}, {"rls", std::nullopt}}), HasSubstr(">2.994<"));
}

}  // namespace
}  // namespace kestrel
