#include "kestrel/lab/planned_runs.hpp"

#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kestrel/lab/benchmark.hpp"
#include "kestrel/lab/camera_experiment.hpp"
#include "kestrel/lab/margins.hpp"

#include "lab/small_plan.hpp"

namespace kestrel {
namespace {

std::vector<std::string> ids_of(const std::vector<PlannedRun>& runs) {
  std::vector<std::string> ids;
  for (const PlannedRun& run : runs) ids.push_back(run.job.id);
  return ids;
}

TEST(PlannedRuns, StandInTheOrderOfTheTables) {
  const auto ids = ids_of(planned_runs(test::small_plan(), "program"));
  const std::vector<std::string> expected{"S0_tutorial/cur",
                                          "S0_tutorial/des",
                                          "S0_tutorial/cur/kz2",
                                          "S3_rz90/cur",
                                          "S3_rz90/des",
                                          "H0/vp3_hh_des",
                                          "H0/vp3_hh_des/kz2",
                                          "map/m/des/x0_y0",
                                          "map/m/des/x1_y0",
                                          "map/m/des/x0_y1",
                                          "map/m/des/x1_y1",
                                          "basin/b/cur/0",
                                          "basin/b/cur/1",
                                          "basin/b/des/0",
                                          "basin/b/des/1",
                                          "margin/S0_tutorial/cur/gain",
                                          "margin/S0_tutorial/cur/delay",
                                          "order/S0_tutorial/des/screw",
                                          "order/S0_tutorial/des/straight_line"};
  EXPECT_EQ(ids, expected);
}

TEST(PlannedRuns, TheBenchmarksPlanMakesTheBenchmarksRuns) {
  LabPlan plan;
  for (const Law law : all_laws()) plan.laws.push_back({name(law), benchmark_law(law)});
  plan.scenarios = benchmark_scenarios();
  for (const std::string& words : benchmark_modifiers()) {
    plan.modifiers.push_back({words, words, {}, {"S0_tutorial", "S3_rz90"}, {}});
  }
  std::vector<std::string> expected;
  for (const CameraExperiment& experiment : benchmark_experiments(0)) {
    expected.push_back(experiment.id());
  }
  EXPECT_EQ(ids_of(planned_runs(plan, "")), expected);
}

TEST(PlannedRuns, DependOnThePlanAndOnTheProgram) {
  const LabPlan plan = test::small_plan();
  LabPlan other = plan;
  other.camera.focal_px = 601;
  const auto runs = planned_runs(plan, "program");
  const auto changed = planned_runs(other, "program");
  const auto rebuilt = planned_runs(plan, "another");
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const bool flies = runs[i].job.id.front() == 'H';
    EXPECT_EQ(runs[i].job.inputs == changed[i].job.inputs, flies) << runs[i].job.id;
    EXPECT_NE(runs[i].job.inputs, rebuilt[i].job.inputs);
  }
}

TEST(PlannedRuns, ARunIsThatOfItsConditions) {
  LabPlan plan = test::small_plan();
  plan.conditions.steps = 60;
  const auto runs = planned_runs(plan, "");
  CameraExperiment experiment{"S0_tutorial", "cur", "kz2", {}, plan.trace_every};
  experiment.setup = {plan.scenarios[0], plan.camera, plan.laws[0].options, plan.conditions,
                      plan.rules};
  experiment.setup.conditions.depth_factor = 2;
  const LabRun expected = run(experiment);
  const LabRun made = runs[2].job.run();
  EXPECT_EQ(made.metrics, expected.metrics);
  EXPECT_EQ(made.modifier, "kz2");
  EXPECT_FALSE(made.trace.rows.empty());
  const LabRun cell = runs[10].job.run();  // depth factor 2, delay 1
  EXPECT_TRUE(cell.trace.rows.empty());
  experiment.setup.law = plan.laws[1].options;
  experiment.setup.conditions.delay_frames = 1;
  EXPECT_EQ(cell.metrics, run(experiment).metrics);
}

TEST(PlannedRuns, AMarginIsTheOneOfItsSetup) {
  LabPlan plan = test::small_plan();
  const auto runs = planned_runs(plan, "");
  const LabRun gain = runs[15].job.run();
  // An integrator at 30 Hz without delay bears a gain of 2 / T (servo.md 2.1), to the bisection's
  // relative tolerance and the small error it starts from.
  ASSERT_TRUE(gain.metrics.at(0).second);
  EXPECT_EQ(gain.metrics[0].first, "gain_limit_per_s");
  EXPECT_NEAR(*gain.metrics[0].second, 60, 0.05);
  EXPECT_EQ(runs[16].job.run().metrics.at(0).first, "delay_limit_frames");
}

TEST(PlannedRuns, AnOrderIsThatOfItsLaw) {
  const auto runs = planned_runs(test::small_plan(), "");
  const LabRun screw = runs[17].job.run();
  ASSERT_EQ(screw.metrics.size(), 1u);
  EXPECT_EQ(screw.metrics[0].first, "slope_to_screw");
  EXPECT_NEAR(screw.metrics[0].second.value_or(0), 2.004, 6e-4);  // three printed digits
  EXPECT_EQ(screw.end, RunEnd::Converged);
  EXPECT_EQ(runs[18].job.run().metrics.at(0).first, "slope_to_straight_line");
}

}  // namespace
}  // namespace kestrel
