#include "kestrel/io/camera_device.hpp"

#include <ctime>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

TEST(MonotonicClock, IsTheOneThatDriversStampWith) {
  timespec before{};
  timespec after{};
  clock_gettime(CLOCK_MONOTONIC, &before);
  const double now_s = monotonic_clock_s();
  clock_gettime(CLOCK_MONOTONIC, &after);
  const auto seconds = [](const timespec& t) {
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
  };
  constexpr double kRounding_s = 1e-6;  // of a double, days after the start
  EXPECT_GE(now_s, seconds(before) - kRounding_s);
  EXPECT_LE(now_s, seconds(after) + kRounding_s);
}

TEST(CaptureClock, HasNames) {
  EXPECT_STREQ(name(CaptureClock::Driver), "driver");
  EXPECT_STREQ(name(CaptureClock::Arrival), "arrival");
}

}  // namespace
}  // namespace kestrel
