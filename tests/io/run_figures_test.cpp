#include "kestrel/io/run_figures.hpp"

#include <algorithm>
#include <cstdio>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/log_rows.hpp"
#include "support/markup_check.hpp"

namespace kestrel {
namespace {

using ::testing::HasSubstr;

std::string joined(const std::vector<ReportSection>& sections) {
  std::string all;
  for (const ReportSection& section : sections)
    for (const std::string& figure : section.figures) all += figure;
  return all;
}

RunView view() {
  RunView out;
  out.image_width = 640;
  out.image_height = 480;
  out.goal_corners = {{{220, 165}, {419, 165}, {419, 314}, {220, 314}}};
  out.limits = CommandLimits{};
  out.position_tolerance_m = 0.1;
  out.angle_tolerance_rad = 0.035;
  return out;
}

TEST(RunFigures, UseTheNamesOfVisp) {
  const std::string all = joined(servo_sections(test::made_up_flight(), view()));
  for (const char* name : {">Visual features error<", ">error_feat_p1_x<", ">error_feat_p4_y<",
                           ">Camera velocities<", ">vc_x<", ">vc_z<", ">wc_z<"})
    EXPECT_THAT(all, HasSubstr(name));
}

TEST(RunFigures, ShowTheStatesByTheirShares) {
  const std::string all = joined(servo_sections(test::made_up_flight(), view()));
  for (const char* words : {">few_matches<", ">no_consensus<", ">found<", ">hover<", ">decay<"})
    EXPECT_THAT(all, HasSubstr(words));
  const LogFile log = test::made_up_flight();
  const auto found = std::count_if(log.rows.begin(), log.rows.end(),
                                   [](const LogRow& row) { return row.corners.has_value(); });
  char share[32];
  std::snprintf(share, sizeof share, ">%.1f %%<", 100. * double(found) / double(log.rows.size()));
  EXPECT_THAT(all, HasSubstr(share));
}

TEST(RunFigures, GiveAHandALaneWhereOneFlew) {
  LogFile log = test::made_up_flight();
  EXPECT_THAT(joined(servo_sections(log, view())), testing::Not(HasSubstr(">sticks<")));
  log.rows[10].decision->state = CommandState::Sticks;
  EXPECT_THAT(joined(servo_sections(log, view())), HasSubstr(">sticks<"));
}

TEST(RunFigures, FlightNeedsTheTruthColumns) {
  EXPECT_EQ(truth_columns(), test::made_up_flight().extra_columns);
  const std::string flown = joined(simulate_sections(test::made_up_flight(), view()));
  EXPECT_THAT(flown, HasSubstr(">Distance to the goal<"));
  LogFile bare = test::made_up_flight();
  bare.extra_columns.clear();
  for (LogRow& row : bare.rows) row.extra.clear();
  EXPECT_THAT(joined(simulate_sections(bare, view())), HasSubstr("no values to show"));
}

TEST(RunFigures, AreWellFormedForAnyLog) {
  test::Random random("run_figures");
  LogFile odd;
  odd.extra_columns = truth_columns();
  for (int i = 0; i < 60; ++i) odd.rows.push_back(test::any_row(random, 8));
  for (const LogFile& log : {LogFile{}, odd, test::made_up_flight()})
    for (const RunView& seen : {RunView{}, view()})
      for (const ReportSection& section : simulate_sections(log, seen))
        for (const std::string& figure : section.figures) {
          EXPECT_EQ(test::markup_fault(figure), "");
          EXPECT_FALSE(std::regex_search(figure, std::regex("=\"-?(nan|inf)")));
        }
}

}  // namespace
}  // namespace kestrel
