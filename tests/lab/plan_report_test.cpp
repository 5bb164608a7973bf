#include "kestrel/lab/plan_report.hpp"

#include <gtest/gtest.h>

#include "lab/made_up_runs.hpp"
#include "lab/small_plan.hpp"

namespace kestrel {
namespace {

TEST(PlanReport, HoldsEveryPartOfThePlan) {
  const LabPlan plan = test::small_plan();
  const auto planned = planned_runs(plan, "");
  std::vector<std::optional<LabRun>> runs;
  for (const PlannedRun& one : planned) {
    const std::string scenario = one.part == LabPart::Margin ? "S0_tutorial" : "s";
    runs.emplace_back(test::made_up_run(scenario, one.law, 2));
    if (one.part == LabPart::Margin) runs.back()->metrics = {{"gain_limit_per_s", 60}};
    const bool is_screw =
        one.part == LabPart::Order && one.job.id.find("screw") != std::string::npos;
    if (one.part == LabPart::Order) {
      runs.back()->metrics = {{is_screw ? "slope_to_screw" : "slope_to_straight_line", 2.5}};
    }
  }
  runs[8]->end = RunEnd::Collision;  // of the map: x = 1, y = 0
  runs[12]->end = RunEnd::Diverged;  // of the basin, law cur
  const LabReport report = report_of(plan, made_runs(planned, std::move(runs)));
  EXPECT_EQ(report.title, "small");
  EXPECT_EQ(report.scenes.size(), 3u);
  EXPECT_EQ(report.runs.size(), 7u);
  ASSERT_EQ(report.maps.size(), 1u);
  EXPECT_EQ(report.maps[0].cells[0][0].value, 14);
  EXPECT_FALSE(report.maps[0].cells[0][1].value);
  EXPECT_EQ(report.maps[0].cells[0][1].end, RunEnd::Collision);
  ASSERT_EQ(report.basins.size(), 2u);
  EXPECT_EQ(report.basins[0].law, "cur");
  EXPECT_EQ(report.basins[0].reached, 1);
  EXPECT_EQ(report.basins[1].reached, 2);
  ASSERT_EQ(report.margins.size(), 1u);
  EXPECT_EQ(report.margins[0].gain_per_s, 60);
  EXPECT_FALSE(report.margins[0].delay_frames);
  ASSERT_EQ(report.orders.size(), 1u);
  EXPECT_EQ(report.orders[0].law, "des");
  EXPECT_EQ(report.orders[0].slope, 2.5);
}

}  // namespace
}  // namespace kestrel
