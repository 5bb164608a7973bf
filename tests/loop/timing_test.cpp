#include "kestrel/loop/timing.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "kestrel/vehicle/gain_limit.hpp"

namespace kestrel {
namespace {

TEST(Timing, TakesTheFirstValueAndAveragesTheNext) {
  const LoopTiming once = with_latency(with_period({}, 0.1), 0.5);
  EXPECT_EQ(once.period_s, 0.1);
  EXPECT_EQ(once.latency_s, 0.5);
  EXPECT_DOUBLE_EQ(*with_period(once, 0.9).period_s, 0.2);
  EXPECT_DOUBLE_EQ(*with_latency(once, 1.3).latency_s, 0.6);
  LoopTiming settled = once;
  for (int i = 0; i < 200; ++i) settled = with_period(settled, 0.03);
  EXPECT_NEAR(*settled.period_s, 0.03, 1e-9);
}

TEST(Timing, LeavesNonsenseOut) {
  LoopTiming timing;
  for (const double x : {0.0, -1.0, double(NAN), double(INFINITY)}) timing = with_period(timing, x);
  for (const double x : {-1e-9, 10.1, double(NAN), double(INFINITY)})
    timing = with_latency(timing, x);
  EXPECT_FALSE(timing.period_s);
  EXPECT_FALSE(timing.latency_s);
}

TEST(Timing, AllowsAShareOfTheLimit) {
  TimingOptions options;
  const LoopTiming timing{0.1, 0.3};
  EXPECT_DOUBLE_EQ(*largest_gain_per_s(timing, options),
                   gain_limit_per_s(0.1, 0.3, options.response) / 4);
  options.gain_share = 0.5;
  EXPECT_DOUBLE_EQ(*largest_gain_per_s(timing, options),
                   gain_limit_per_s(0.1, 0.3, options.response) / 2);
  options.latency_s = 0.7;  // said, so that what is measured does not count
  EXPECT_DOUBLE_EQ(*largest_gain_per_s(timing, options),
                   gain_limit_per_s(0.1, 0.7, options.response) / 2);
}

// A recording has no latency, and a first frame no period: then nothing is limited.
TEST(Timing, AllowsAllWhileItIsUnknown) {
  EXPECT_FALSE(largest_gain_per_s({}, {}));
  EXPECT_FALSE(largest_gain_per_s({0.1, std::nullopt}, {}));
  EXPECT_FALSE(largest_gain_per_s({std::nullopt, 0.1}, {}));
}

TEST(Timing, RefusesOptionsOutOfRange) {
  const auto named = [](auto change) -> std::string {
    TimingOptions o;
    change(o);
    try {
      o.check();
    } catch (const std::invalid_argument& e) {
      return std::string(e.what()).substr(0, std::string(e.what()).find(':'));
    }
    return "";
  };
  EXPECT_EQ(named([](TimingOptions& o) { o.gain_share = 0; }), "gain_share");
  EXPECT_EQ(named([](TimingOptions& o) { o.latency_s = -1; }), "latency_s");
  EXPECT_EQ(named([](TimingOptions& o) { o.latency_s = NAN; }), "latency_s");
  EXPECT_EQ(named([](TimingOptions& o) { o.response.tilt_s = 0; }), "tilt_s");
  EXPECT_EQ(named([](TimingOptions&) {}), "");
}

TEST(Timing, NamesItsPredictions) {
  EXPECT_STREQ(name(Prediction::Off), "off");
  EXPECT_STREQ(name(Prediction::Measured), "measured");
  EXPECT_STREQ(name(Prediction::Commanded), "commanded");
}

}  // namespace
}  // namespace kestrel
