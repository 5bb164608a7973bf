#include "kestrel/lab/plan_modifier.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using ::testing::HasSubstr;

constexpr double kDegree = M_PI / 180;

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

TEST(PlanModifier, AModifiersSettingsComeAfterItsWords) {
  const PlannedModifier modifier{"m", "kz2_d3", {{"depth_factor", 0.5}}, {}, {}};
  const Conditions changed = with_modifier(Conditions{}, modifier);
  EXPECT_EQ(changed.depth_factor, 0.5);
  EXPECT_EQ(changed.delay_frames, 3);
  const HelicopterConditions flown = with_modifier(HelicopterConditions{}, modifier);
  EXPECT_EQ(flown.depth_factor, 0.5);
  EXPECT_EQ(flown.delay_frames, 3);
}

TEST(PlanModifier, AppliesToTheScenariosAndLawsItNames) {
  PlannedModifier modifier{"m", "", {}, {}, {}};
  EXPECT_TRUE(applies(modifier, "s", "a"));
  modifier.scenarios = {"s"};
  EXPECT_TRUE(applies(modifier, "s", "a"));
  EXPECT_FALSE(applies(modifier, "t", "a"));
  modifier.laws = {"b"};
  EXPECT_FALSE(applies(modifier, "s", "a"));
  EXPECT_TRUE(applies(modifier, "s", "b"));
}

HelicopterConditions with(const std::vector<ConditionSetting>& settings) {
  return with_modifier(HelicopterConditions{}, {"m", "", settings, {}, {}});
}

TEST(HelicopterConditionKeys, SetWhatTheySay) {
  const HelicopterConditions c = with({{"gain_per_s", 2},
                                       {"duration_s", 3},
                                       {"period_frames", 4},
                                       {"delay_frames", 5},
                                       {"predicted", 1},
                                       {"feed_forward", 1},
                                       {"depth_factor", 6},
                                       {"noise_px", 7},
                                       {"seed", 8},
                                       {"roll_bias_deg", 9},
                                       {"pitch_bias_deg", 10},
                                       {"yaw_bias_deg", 11}});
  EXPECT_EQ(c.gain_per_s, 2);
  EXPECT_EQ(c.duration_s, 3);
  EXPECT_EQ(c.period_frames, 4);
  EXPECT_EQ(c.delay_frames, 5);
  EXPECT_TRUE(c.predicted);
  EXPECT_TRUE(c.feed_forward);
  EXPECT_EQ(c.depth_factor, 6);
  EXPECT_EQ(c.noise_px, 7);
  EXPECT_EQ(c.seed, 8u);
  EXPECT_DOUBLE_EQ(c.roll_bias_rad, 9 * kDegree);
  EXPECT_DOUBLE_EQ(c.pitch_bias_rad, 10 * kDegree);
  EXPECT_DOUBLE_EQ(c.yaw_bias_rad, 11 * kDegree);
}

TEST(HelicopterConditionKeys, SetLimits) {
  const HelicopterConditions c = with({{"limited", 0},
                                       {"limited", 1},
                                       {"limit_forward_m_s", 1},
                                       {"limit_right_m_s", 2},
                                       {"limit_down_m_s", 3},
                                       {"limit_yaw_deg_s", 4},
                                       {"acceleration_forward_m_s2", 5},
                                       {"acceleration_right_m_s2", 6},
                                       {"acceleration_down_m_s2", 7},
                                       {"acceleration_yaw_deg_s2", 8},
                                       {"limited", 1}});  // leaves what there is
  ASSERT_TRUE(c.limits);
  const Eigen::Vector4d speed(1, 2, 3, 4 * kDegree);
  const Eigen::Vector4d acceleration(5, 6, 7, 8 * kDegree);
  EXPECT_TRUE(c.limits->speed.vector().isApprox(speed, 1e-15));
  EXPECT_TRUE(c.limits->acceleration.vector().isApprox(acceleration, 1e-15));
  EXPECT_FALSE(with({{"limited", 0}}).limits);
}

TEST(HelicopterConditionKeys, SetLossFailsafeAndPlant) {
  const HelicopterConditions c = with({{"loss_from_s", 1},
                                       {"reaction", 2},
                                       {"hold_s", 0.2},
                                       {"decay_s", 0.3},
                                       {"hover_after_s", 4},
                                       {"tau_v_s", 5},
                                       {"tau_a_s", 6},
                                       {"tau_z_s", 7},
                                       {"tau_r_s", 8},
                                       {"max_tilt_deg", 9}});
  EXPECT_EQ(c.loss->from_s, 1);
  EXPECT_GE(c.loss->for_s, 3600);  // the longest run: to its end
  EXPECT_EQ(c.reaction, LossReaction::Hover);
  EXPECT_EQ(c.failsafe.hold_s, 0.2);
  EXPECT_EQ(c.failsafe.decay_s, 0.3);
  EXPECT_EQ(c.failsafe.hover_after_s, 4);
  EXPECT_EQ(c.plant.tau_v_s, 5);
  EXPECT_EQ(c.plant.tau_a_s, 6);
  EXPECT_EQ(c.plant.tau_z_s, 7);
  EXPECT_EQ(c.plant.tau_r_s, 8);
  EXPECT_DOUBLE_EQ(c.plant.max_tilt_rad, 9 * kDegree);
  EXPECT_EQ(with({{"loss_from_s", 1}, {"loss_for_s", 2}}).loss->for_s, 2);
}

TEST(HelicopterConditionKeys, RefuseWhatTheyCannotTake) {
  const auto message = [](const char* key, double value) {
    return test::message_of([&] { with_setting(HelicopterConditions{}, {key, value}); });
  };
  EXPECT_THAT(message("noise", 1), HasSubstr("did you mean noise_px?"));
  EXPECT_THAT(message("steps", 1), HasSubstr("steps: is no key of the conditions"));
  EXPECT_THAT(message("predicted", 2), HasSubstr("no whole number"));
  EXPECT_THAT(message("reaction", 3), HasSubstr("no whole number"));
  EXPECT_THAT(message("period_frames", 0), HasSubstr("period_frames must be 1 or more"));
  EXPECT_THAT(message("limit_down_m_s", 0), HasSubstr("down"));
  EXPECT_THAT(message("tau_v_s", -1), HasSubstr("tau_v_s"));
}

}  // namespace
}  // namespace kestrel
