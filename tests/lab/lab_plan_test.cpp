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
  plan.helicopter = {helicopter_scenarios(), {"vp5_mean"}, {}};
  EXPECT_THAT(fault(plan), HasSubstr("no law vp5_mean"));
}

TEST(ConditionKeys, SetWhatTheySay) {
  Conditions c;
  double value = 2;
  for (const std::string& key : condition_keys()) c = with_setting(c, {key, value++});
  EXPECT_EQ(c.gain_per_s, 2);
  EXPECT_EQ(c.rate_hz, 3);
  EXPECT_EQ(c.steps, 4);
  EXPECT_EQ(c.depth_factor, 5);
  EXPECT_EQ(c.focal_factor, 6);
  EXPECT_EQ(c.principal_u_px, 7);
  EXPECT_EQ(c.principal_v_px, 8);
  EXPECT_EQ(c.noise_px, 9);
  EXPECT_EQ(c.seed, 10u);
  EXPECT_EQ(c.delay_frames, 11);
  ASSERT_TRUE(c.limits);
  EXPECT_EQ(c.limits->linear_m_s, 12);
  EXPECT_DOUBLE_EQ(c.limits->angular_rad_s, 13 * M_PI / 180);
}

TEST(ConditionKeys, RefuseWhatTheyCannotTake) {
  const auto message = [](const char* key, double value) {
    return test::message_of([&] { with_setting(Conditions{}, {key, value}); });
  };
  EXPECT_THAT(message("depth_facter", 1), HasSubstr("did you mean depth_factor?"));
  EXPECT_THAT(message("delay_frames", 1.5), HasSubstr("no whole number"));
  EXPECT_THAT(message("delay_frames", -1), HasSubstr("no whole number"));
  EXPECT_THAT(message("depth_factor", 0), HasSubstr("depth_factor must be above 0"));
}

TEST(LabPlan, AModifiersSettingsComeAfterItsWords) {
  const PlannedModifier modifier{"m", "kz2_d3", {{"depth_factor", 0.5}}, {}, {}};
  const Conditions changed = with_modifier({}, modifier);
  EXPECT_EQ(changed.depth_factor, 0.5);
  EXPECT_EQ(changed.delay_frames, 3);
}

TEST(LabPlan, ATurnIsAboutTheGoalsOpticalAxis) {
  const Scenario scenario = turned(benchmark_scenarios()[0], 45);
  const GoalFromCamera start = scenario.start_in_goal();
  EXPECT_LT(start.translation.norm(), 1e-15);
  EXPECT_TRUE(rotation_vector(start.rotation).isApprox(Eigen::Vector3d(0, 0, M_PI / 4), 1e-12));
}

TEST(LabPlan, ReadsTheLabelsOfLawsOnAHelicopter) {
  EXPECT_EQ(helicopter_law_labelled("vp3_hh_mean"), std::pair(HelicopterVariant::Vp3Hh, Law::Mean));
  EXPECT_EQ(helicopter_law_labelled("vp3_des"), std::pair(HelicopterVariant::Vp3, Law::Des));
  EXPECT_EQ(helicopter_law_labelled("mejias"),
            std::pair(HelicopterVariant::Mejias, Law::Decoupled));
}

}  // namespace
}  // namespace kestrel
