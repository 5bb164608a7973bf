#include "kestrel/link/sender_clock.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace kestrel {
namespace {

std::uint32_t stamp(double clock_s) {
  return std::uint32_t(std::uint64_t(std::int64_t(std::round(clock_s * 1000))));
}

// Whatever stands between the clocks, ages are right to the shortest delay so far, the millisecond
// of the stamp and what the drift lets pass.
TEST(SenderClock, TellsTheAgeToTheShortestDelay) {
  test::Random random("sender clock");
  for (const double offset_s : {0.0, -3000.5, 4294960.0, 1e9}) {
    SenderClock clock;
    double shortest_s = 1e9;
    for (int i = 0; i < 600; ++i) {
      const double captured_s = 100 + i / 30.0;
      const double delay_s = 0.02 + random.uniform(0, 0.3);
      shortest_s = std::min(shortest_s, delay_s);
      const std::uint32_t ms = stamp(captured_s + offset_s);
      clock.learn(ms, captured_s + delay_s);
      EXPECT_NEAR(clock.age_s(ms, captured_s + delay_s), delay_s - shortest_s,
                  0.0011 + SenderClock::kDrift * 20);
    }
  }
}

TEST(SenderClock, SeesAStampThatStandsStill) {
  SenderClock clock;
  clock.learn(5000, 1);
  for (double later_s = 0; later_s < 100; later_s += 0.5) {
    clock.learn(5000, 1 + later_s);
    EXPECT_NEAR(clock.age_s(5000, 1 + later_s), later_s, SenderClock::kDrift * 100);
  }
}

// Clocks that differ by 100 ppm for a day, 8.6 s: an honest sender stays fresh.
TEST(SenderClock, FollowsADriftingClock) {
  for (const double rate : {1 - 1e-4, 1 + 1e-4}) {
    SenderClock clock;
    for (double now_s = 0; now_s < 86400; now_s += 5) {
      clock.learn(stamp(now_s * rate), now_s);
      EXPECT_LT(clock.age_s(stamp(now_s * rate), now_s), 0.005);
    }
  }
}

TEST(SenderClock, ShowsAStampOfTheFutureAsNegativeAge) {
  SenderClock clock;
  EXPECT_EQ(clock.age_s(123, 4), 0);
  clock.learn(1000, 1);
  EXPECT_NEAR(clock.age_s(9000, 2), -7, 0.001);
}

TEST(StampDifference, GoesAcrossTheWrap) {
  EXPECT_DOUBLE_EQ(stamp_difference_s(5, 4294967291u), 0.010);
  EXPECT_DOUBLE_EQ(stamp_difference_s(4294967291u, 5), -0.010);
}

}  // namespace
}  // namespace kestrel
