#include "kestrel/lab/helicopter_conditions.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

TEST(HelicopterConditions, WordsChangeWhatTheySay) {
  const HelicopterConditions c = modified({}, "kz2_p3_d6_l0.5_n1_t20_roll1_pitch-2_yaw3_pred_ff");
  EXPECT_EQ(c.depth_factor, 2);
  EXPECT_EQ(c.period_frames, 3);
  EXPECT_EQ(c.delay_frames, 6);
  EXPECT_EQ(c.gain_per_s, 0.5);
  EXPECT_EQ(c.noise_px, 1);
  EXPECT_EQ(c.duration_s, 20);
  EXPECT_NEAR(c.roll_bias_rad, M_PI / 180, 1e-15);
  EXPECT_NEAR(c.pitch_bias_rad, -2 * M_PI / 180, 1e-15);
  EXPECT_NEAR(c.yaw_bias_rad, 3 * M_PI / 180, 1e-15);
  EXPECT_TRUE(c.predicted);
  EXPECT_TRUE(c.feed_forward);
  EXPECT_TRUE(c.limits);
}

TEST(HelicopterConditions, LimitsLossAndTheSeed) {
  EXPECT_FALSE(modified({}, "free").limits);
  const HelicopterConditions lost = modified({}, "loss2_hover");
  ASSERT_TRUE(lost.loss);
  EXPECT_EQ(lost.loss->from_s, 2);
  EXPECT_EQ(lost.loss->for_s, 40);
  EXPECT_EQ(lost.reaction, LossReaction::Hover);
  EXPECT_EQ(modified({}, "hold").reaction, LossReaction::Hold);
  const HelicopterConditions seed = modified({}, "seed0.93");
  EXPECT_EQ(seed.period_frames, 28);
  EXPECT_EQ(seed.delay_frames, 28);
  EXPECT_EQ(seed.duration_s, 80);
}

TEST(HelicopterConditions, NoWordNoChange) {
  HelicopterConditions c;
  c.noise_px = 0.25;
  EXPECT_EQ(modified(c, "").noise_px, 0.25);
  EXPECT_EQ(modified(c, "").limits.has_value(), true);
}

TEST(HelicopterConditions, UnknownWordsAreNamed) {
  for (const char* word : {"k2", "kz", "kz2x", "d1.5", "d-1", "p0", "seed", "kzinf", "free2", "_",
                           "pitch90", "roll", "t0", "n-1", "predicted"}) {
    EXPECT_THROW(modified({}, word), std::invalid_argument) << word;
  }
}

TEST(HelicopterConditions, NonsenseIsNamed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto wrong = [](const std::function<void(HelicopterConditions&)>& change) {
    HelicopterConditions c;
    change(c);
    EXPECT_THROW(c.check(), std::invalid_argument);
  };
  wrong([](auto& c) { c.gain_per_s = 0; });
  wrong([&](auto& c) { c.duration_s = nan; });
  wrong([](auto& c) { c.period_frames = 0; });
  wrong([](auto& c) { c.delay_frames = -1; });
  wrong([](auto& c) { c.depth_factor = 0; });
  wrong([&](auto& c) { c.noise_px = nan; });
  wrong([&](auto& c) { c.roll_bias_rad = nan; });
  wrong([&](auto& c) { c.yaw_bias_rad = nan; });
  wrong([](auto& c) { c.loss = TargetLoss{-1, 1}; });
  wrong([&](auto& c) { c.loss = TargetLoss{1, nan}; });
  wrong([](auto& c) { c.limits->speed.forward_m_s = 0; });
  wrong([](auto& c) { c.failsafe.decay_s = 0; });
  wrong([](auto& c) { c.plant.tau_v_s = 0; });
}

TEST(HelicopterConditions, ReactionsHaveNames) {
  EXPECT_STREQ(name(LossReaction::Failsafe), "failsafe");
  EXPECT_STREQ(name(LossReaction::Hold), "hold");
  EXPECT_STREQ(name(LossReaction::Hover), "hover");
}

}  // namespace
}  // namespace kestrel
