#include "kestrel/lab/margins.hpp"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "lab/lab_setup.hpp"

namespace kestrel {
namespace {

MarginOptions quick() {
  MarginOptions options;
  options.steps = 300;
  options.gain_tolerance = 1e-3;
  return options;
}

TEST(Margins, GainLimitOfAnIntegratorWithDelay) {
  for (const int delay : {0, 2}) {
    CameraSetup setup = test::benchmark_setup("S1_small", Law::Des, 1);
    setup.conditions.delay_frames = delay;
    const double critical_per_s = 30 * 2 * std::sin(M_PI / (2 * (2 * delay + 1)));
    const auto margin = gain_margin(setup, quick());
    ASSERT_TRUE(margin);
    // Relative: 0.1 % of the bisection, and the loop is linear up to the offset of 1e-4.
    EXPECT_NEAR(*margin / critical_per_s, 1, 3e-3) << delay;
  }
}

TEST(Margins, DelayLimitIsThatOfTheGain) {
  CameraSetup setup = test::benchmark_setup("S1_small", Law::Des, 1);
  setup.conditions.gain_per_s = 30 * 0.4;  // .347 < .4 < .445: between the limits of 4 and 3 frames
  EXPECT_EQ(delay_margin(setup, quick()), 3);
  setup.conditions.gain_per_s = 70;  // beyond 2 / T
  EXPECT_FALSE(delay_margin(setup, quick()));
}

TEST(Margins, OfAScenarioEndWhereItsRunFails) {
  MarginOptions options = quick();
  options.stability = Stability::Scenario;
  options.largest_gain_per_s = 10;
  CameraSetup setup = test::benchmark_setup("S5_rz160", Law::Des, 1);  // collides at any gain
  EXPECT_FALSE(gain_margin(setup, options));
  setup = test::benchmark_setup("S1_small", Law::Cur, 1);
  options.smallest_gain_per_s = 1;
  EXPECT_EQ(gain_margin(setup, options), 10);  // stable at the largest
}

// An error that nobody touches does not grow; that is no stability.
TEST(Margins, ALawThatRefusesHasNone) {
  CameraSetup setup = test::benchmark_setup("S1_small", Law::Des, 1);
  setup.law.max_condition = 1;
  EXPECT_FALSE(gain_margin(setup, quick()));
  EXPECT_FALSE(delay_margin(setup, quick()));
}

TEST(Margins, CheckNamesWhatIsOutOfRange) {
  MarginOptions options;
  options.largest_gain_per_s = 0;
  EXPECT_THROW(options.check(), std::invalid_argument);
  options = {};
  options.steps = 2;
  EXPECT_THROW(is_stable(test::benchmark_setup("S1_small", Law::Cur, 1), options),
               std::invalid_argument);
}

}  // namespace
}  // namespace kestrel
