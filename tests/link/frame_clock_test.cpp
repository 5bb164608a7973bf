#include "kestrel/link/frame_clock.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace kestrel {
namespace {

constexpr double kAhead_s = 1234.5;  // our clock minus theirs

TEST(FrameClock, KnowsNothingBeforeTheFirstFrame) { EXPECT_FALSE(FrameClock().ours(1)); }

// A queue makes frames late, never early: the shortest way bounds the error of all that follow.
TEST(FrameClock, TheShortestWayCounts) {
  FrameClock clock;
  test::Random random("ways of frames");
  double shortest_s = 1;
  for (int k = 0; k < 300; ++k) {
    const double way_s = random.uniform(0.0005, 0.1);
    shortest_s = std::min(shortest_s, way_s);
    clock.learn(k / 30.0, k / 30.0 + kAhead_s + way_s);
    const double error_s = *clock.ours(k / 30.0) - (k / 30.0 + kAhead_s);
    EXPECT_GE(error_s, 0);
    // What the drift lets it forget in these ten seconds is 2 ms.
    EXPECT_LE(error_s, shortest_s + 10 * FrameClock::kDrift);
  }
}

// A sender whose crystal runs slow drifts away from the shortest way; it is followed.
TEST(FrameClock, FollowsAClockThatDrifts) {
  FrameClock clock;
  for (int k = 0; k < 30 * 600; ++k) {
    const double theirs_s = k / 30.0;
    const double ours_s = kAhead_s + theirs_s * (1 + 1e-4);  // 100 ppm
    clock.learn(theirs_s, ours_s + 0.001);
    EXPECT_NEAR(*clock.ours(theirs_s), ours_s, 0.002);
  }
}

}  // namespace
}  // namespace kestrel
