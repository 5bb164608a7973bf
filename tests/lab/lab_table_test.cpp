#include "kestrel/lab/lab_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kestrel/lab/lab_store.hpp"

#include "lab/made_up_runs.hpp"
#include "lab/small_plan.hpp"

namespace kestrel {
namespace {

using ::testing::HasSubstr;

MadeRun made(LabPart part, const std::string& scenario, const std::string& law, RunEnd end,
             std::size_t x = 0, std::size_t y = 0) {
  MadeRun made{part, 0, x, y, storable(test::made_up_run(scenario, law, 5))};
  made.run.end = end;
  return made;
}

TEST(LabTable, ResultsHaveARowForEachRunAndEmptyFieldsForWhatIsMissing) {
  std::vector<MadeRun> runs{made(LabPart::Table, "S0", "cur", RunEnd::Converged),
                            made(LabPart::Table, "S0", "des", RunEnd::Refused),
                            made(LabPart::Map, "m", "des", RunEnd::Converged)};
  runs[1].run.refusal = LawRefusal::Singular;
  runs[1].run.metrics = {{"settle_s", 2.5}};
  EXPECT_EQ(csv(results_table(runs)),
            "scenario,law,modifier,world,end,refusal,steps,k_error,first_out_of_view,condition,"
            "settle_s\n"
            "S0,cur,,camera,converged,,3,35,,,\n"
            "S0,des,,camera,refused,singular,3,,,,2.5\n");
}

TEST(LabTable, OutcomesCrossLawsWithScenariosAndWithModifiers) {
  std::vector<MadeRun> runs{made(LabPart::Table, "S0", "cur", RunEnd::Converged),
                            made(LabPart::Table, "S1", "cur", RunEnd::Collision),
                            made(LabPart::Table, "S0", "des", RunEnd::Diverged),
                            made(LabPart::Table, "S0", "cur", RunEnd::Converged)};
  runs[3].run.modifier = "kz2";
  const auto tables = outcome_tables(runs);
  ASSERT_EQ(tables.size(), 2u);
  EXPECT_EQ(tables[0].head, (std::vector<std::string>{"law", "S0", "S1"}));
  EXPECT_EQ(tables[0].rows[0], (std::vector<std::string>{"cur", "35", "collision"}));
  EXPECT_EQ(tables[0].rows[1], (std::vector<std::string>{"des", "diverged", ""}));
  EXPECT_EQ(tables[1].head, (std::vector<std::string>{"law", "kz2"}));
  EXPECT_THAT(tables[1].caption, HasSubstr("S0"));
}

TEST(LabTable, SharesHaveWilsonsInterval) {
  // Newcombe 1998 (Stat. Med. 17), table I: 81 of 263 has 0.2553 to 0.3662, 0 of 20 has 0 to
  // 0.1611, both without continuity correction.
  EXPECT_NEAR(share_of(81, 263).low, 0.2553, 5e-5);
  EXPECT_NEAR(share_of(81, 263).high, 0.3662, 5e-5);
  EXPECT_NEAR(share_of(0, 20).low, 0, 1e-15);
  EXPECT_NEAR(share_of(0, 20).high, 0.1611, 5e-5);
  EXPECT_NEAR(share_of(20, 20).low, 1 - 0.1611, 5e-5);
  EXPECT_EQ(share_of(0, 0).high, 1);
}

TEST(LabTable, BasinsMapsMarginsAndOrdersHaveTablesOfTheirOwn) {
  const LabPlan plan = test::small_plan();
  std::vector<MadeRun> runs{made(LabPart::Basin, "b", "cur", RunEnd::Converged, 0),
                            made(LabPart::Basin, "b", "cur", RunEnd::Collision, 1),
                            made(LabPart::Map, "m", "des", RunEnd::Diverged, 1, 0),
                            made(LabPart::Margin, "S0_tutorial", "cur", RunEnd::Converged),
                            made(LabPart::Margin, "S0_tutorial", "cur", RunEnd::Converged),
                            made(LabPart::Order, "S0_tutorial", "des", RunEnd::Converged),
                            made(LabPart::Order, "S0_tutorial", "des", RunEnd::Converged)};
  runs[3].run.metrics = {{"gain_limit_per_s", 60}};
  runs[4].run.metrics = {{"delay_limit_frames", 46}};
  runs[5].run.metrics = {{"slope_to_screw", 2}};
  runs[6].run.metrics = {{"slope_to_straight_line", 3}};
  EXPECT_THAT(csv(basin_table(plan, runs)), HasSubstr("\nb,cur,1,2,50,"));
  EXPECT_THAT(csv(basin_run_table(plan, runs)), HasSubstr("\nb,1,cur,collision,,3,35"));
  EXPECT_THAT(csv(map_table(plan, 0, runs)),
              HasSubstr("law,depth_factor,delay_frames,end,refusal,steps,k_error,first_out_of_view,"
                        "condition\ndes,2,0,diverged"));
  EXPECT_EQ(csv(margin_table(plan, runs)),
            "scenario,law,gain_limit_per_s,delay_limit_frames\nS0_tutorial,cur,60,46\n");
  EXPECT_EQ(csv(order_table(plan, runs)),
            "scenario,law,slope_to_screw,slope_to_straight_line\nS0_tutorial,des,2,3\n");
}

TEST(LabTable, RunsThatWereNotMadeAreLeftOut) {
  const auto planned = planned_runs(test::small_plan(), "");
  std::vector<std::optional<LabRun>> runs(planned.size());
  runs[1] = test::made_up_run("S0_tutorial", "des", 1);
  runs[8] = test::made_up_run("m", "des", 1);
  const auto left = made_runs(planned, std::move(runs));
  ASSERT_EQ(left.size(), 2u);
  EXPECT_EQ(left[0].run.law, "des");
  EXPECT_EQ(left[1].part, LabPart::Map);
  EXPECT_EQ(left[1].x, 1u);
}

}  // namespace
}  // namespace kestrel
