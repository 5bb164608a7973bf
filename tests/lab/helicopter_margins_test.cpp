#include "kestrel/lab/helicopter_margins.hpp"

#include <gtest/gtest.h>

#include "kestrel/lab/helicopter_benchmark.hpp"

#include "lab/support/lateral_loop.hpp"

namespace kestrel {
namespace {

HelicopterSetup loop_of(int period_frames, int delay_frames) {
  HelicopterSetup setup =
      helicopter_experiment(helicopter_h0(), HelicopterVariant::Vp3, Law::Des).setup;
  setup.conditions.period_frames = period_frames;
  setup.conditions.delay_frames = delay_frames;
  return setup;
}

// The eigenvalues of the linear loop know the limit; the flight is asked 1.5 % below and above it.
TEST(HelicopterMargins, TheLimitIsThatOfTheLinearLoop) {
  for (const auto& [period, delay] : {std::pair{1, 0}, {1, 6}, {28, 28}}) {
    const double limit_per_s = test::lateral_gain_limit_oracle(period, delay);
    const HelicopterSetup setup = loop_of(period, delay);
    EXPECT_TRUE(settles_laterally(setup, 0.985 * limit_per_s)) << period << ' ' << delay;
    EXPECT_FALSE(settles_laterally(setup, 1.015 * limit_per_s)) << period << ' ' << delay;
  }
}

TEST(HelicopterMargins, PredictionLeavesTheLimitWithoutLatency) {
  HelicopterSetup setup = loop_of(1, 6);
  setup.conditions.predicted = true;
  const double limit_per_s = test::lateral_gain_limit_oracle(1, 0);
  EXPECT_TRUE(settles_laterally(setup, 0.985 * limit_per_s));
  EXPECT_FALSE(settles_laterally(setup, 1.015 * limit_per_s));
}

TEST(HelicopterMargins, BisectionFindsIt) {
  HelicopterMarginOptions options;
  options.low_per_s = 4;
  options.high_per_s = 6;
  options.relative_tolerance = 0.02;
  const auto limit_per_s = lateral_gain_limit(loop_of(1, 1), options);
  ASSERT_TRUE(limit_per_s);
  EXPECT_NEAR(*limit_per_s, test::lateral_gain_limit_oracle(1, 1), 0.02 * 4.7);
  options.high_per_s = 4.2;
  EXPECT_FALSE(lateral_gain_limit(loop_of(1, 1), options));  // settles at the highest
  options.low_per_s = 7;
  options.high_per_s = 8;
  EXPECT_FALSE(lateral_gain_limit(loop_of(1, 1), options));  // does not settle at the lowest
}

TEST(HelicopterMargins, TheLatencyThatIsLeft) {
  HelicopterSetup setup = loop_of(1, 0);
  setup.conditions.gain_per_s = 3;
  int longest = 0;
  while (test::lateral_spectral_radius(3, 1, longest + 1) < 1) ++longest;
  EXPECT_EQ(lateral_delay_limit(setup, 16), longest);
  setup.conditions.gain_per_s = 7;
  EXPECT_FALSE(lateral_delay_limit(setup, 16));
}

TEST(HelicopterMargins, OptionsAreChecked) {
  HelicopterMarginOptions options;
  options.low_per_s = 0;
  EXPECT_THROW(settles_laterally(loop_of(1, 0), 1, options), std::invalid_argument);
  options = {};
  options.high_per_s = options.low_per_s;
  EXPECT_THROW(settles_laterally(loop_of(1, 0), 1, options), std::invalid_argument);
  options = {};
  options.offset_m = -1;
  EXPECT_THROW(settles_laterally(loop_of(1, 0), 1, options), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel
