#include "kestrel/lab/lab_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kestrel/geometry/rotation.hpp"
#include "kestrel/lab/benchmark.hpp"

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using ::testing::HasSubstr;

LabPlan small_plan() {
  LabPlan plan;
  plan.laws = {{"cur", benchmark_law(Law::Cur)}, {"des", benchmark_law(Law::Des)}};
  plan.scenarios = {benchmark_scenarios()[0], benchmark_scenarios()[3]};
  return plan;
}

std::string fault(const LabPlan& plan) {
  return test::message_of([&] { plan.check(); });
}

TEST(LabPlan, NamesWhatIsWrong) {
  EXPECT_NO_THROW(small_plan().check());
  EXPECT_THAT(fault(LabPlan{}), HasSubstr("nothing to run"));
  LabPlan plan = small_plan();
  plan.laws.push_back(plan.laws[0]);
  EXPECT_THAT(fault(plan), HasSubstr("two of the laws are called cur"));
  plan = small_plan();
  plan.scenarios[1].name = "a/b";
  EXPECT_THAT(fault(plan), HasSubstr("'a/b' is no plain name"));
  plan.scenarios[1].name = "map";
  EXPECT_THAT(fault(plan), HasSubstr("map"));
  plan = small_plan();
  plan.modifiers = {{"kz2", "kz2", {}, {"S9"}, {}}};
  EXPECT_THAT(fault(plan), HasSubstr("no scenario S9"));
  plan.modifiers = {{"kz2", "kz2", {}, {}, {"mean"}}};
  EXPECT_THAT(fault(plan), HasSubstr("no law labelled mean"));
  plan = small_plan();
  plan.maps = {{"m", "S0_tutorial", {}, {"depth_factor", {1}}, {"depth_factor", {1}}}};
  EXPECT_THAT(fault(plan), HasSubstr("both depth_factor"));
  plan.maps[0].y = {"noise_px", {-1}};
  EXPECT_THAT(fault(plan), HasSubstr("noise_px"));
  plan = small_plan();
  plan.basins = {{"b", "S0_tutorial", {}, {}}};
  EXPECT_THAT(fault(plan), HasSubstr("no starts"));
  plan = small_plan();
  plan.helicopter.scenarios = {helicopter_h0(), helicopter_h0()};
  EXPECT_THAT(fault(plan), HasSubstr("two of the scenarios are called H0"));
  plan.helicopter.scenarios = {helicopter_h0()};
  plan.helicopter.laws = {benchmark_helicopter_law("mejias"), benchmark_helicopter_law("mejias")};
  EXPECT_THAT(fault(plan), HasSubstr("two of the laws are called mejias"));
  plan.helicopter.laws.pop_back();
  plan.helicopter.modifiers = {{"n1", "n1", {}, {}, {}}, {"n1", "n2", {}, {}, {}}};
  EXPECT_THAT(fault(plan), HasSubstr("two of the modifiers are called n1"));
}

TEST(LabPlan, ATurnIsAboutTheGoalsOpticalAxis) {
  const Scenario scenario = turned(benchmark_scenarios()[0], 45);
  const GoalFromCamera start = scenario.start_in_goal();
  EXPECT_LT(start.translation.norm(), 1e-15);
  EXPECT_TRUE(rotation_vector(start.rotation).isApprox(Eigen::Vector3d(0, 0, M_PI / 4), 1e-12));
}

}  // namespace
}  // namespace kestrel
