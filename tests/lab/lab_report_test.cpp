#include "kestrel/lab/lab_report.hpp"

#include <gtest/gtest.h>

#include "lab/made_up_report.hpp"

namespace kestrel {
namespace {

TEST(Outcome, IsTheStepOrTheReason) {
  LabRun run = test::made_up_run("S", "cur");
  EXPECT_EQ(outcome(run), "42");
  run.end = RunEnd::LocalMinimum;
  EXPECT_EQ(outcome(run), "local minimum");
  run.end = RunEnd::Refused;
  run.refusal = LawRefusal::FewPoints;
  EXPECT_EQ(outcome(run), "refused: few points");
  run.end = RunEnd::Converged;
  run.metrics = {{"settle_s", 6.26}};
  EXPECT_EQ(outcome(run), "6.3 s");
  run.metrics = {{"k_error", std::nullopt}};
  EXPECT_EQ(outcome(run), "converged");
}

TEST(LabNames, KeepTheOrderOfTheRuns) {
  const LabReport report = test::made_up_report();
  EXPECT_EQ(scenarios_of(report.runs).all(), (std::vector<std::string>{"S2_rz45", "S3_rz90"}));
  EXPECT_EQ(modifiers_of(report.runs).all(), (std::vector<std::string>{"", "kz2"}));
  EXPECT_EQ(laws_of(report.runs).place("cur"), 0);
  EXPECT_EQ(laws_of(report.runs).place("none"), -1);
}

TEST(SceneNamed, IsNullForAnUnknownOne) {
  const LabReport report = test::made_up_report();
  ASSERT_NE(scene_named(report, "S3_rz90"), nullptr);
  EXPECT_EQ(scene_named(report, "S3_rz90")->scenario, "S3_rz90");
  EXPECT_EQ(scene_named(report, "S9"), nullptr);
}

}  // namespace
}  // namespace kestrel
