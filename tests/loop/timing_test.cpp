#include "kestrel/loop/timing.hpp"

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "kestrel/loop/decide.hpp"
#include "kestrel/vehicle/gain_limit.hpp"

#include "loop/flight.hpp"

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

/// A vehicle a metre off its goal, with heading and no tilt.
const test::Flight kFlight{{0.4, -0.6, 0.3}, {0, 0, 0.5}};

/// What is decided where the camera is, in a loop of 30 Hz that was hovering.
Decision decided(const test::Flight& flight, const Task& task,
                 const std::optional<Eigen::Vector3d>& velocity_ned_m_s) {
  DecisionState state;
  state.stamp_s = 10;
  state.timing.period_s = 1. / 30;
  const auto seen =
      test::seen_from(flight.camera(task.body_from_camera), test::target_for(task), task);
  return decide(seen, flight.attitude, 10 + 1. / 30, state, task, velocity_ned_m_s);
}

// The command at a gain beyond the limit is the one at the limit; the gain far
// from the goal is no way around it.
TEST(Timing, HoldsTheLawToItsLimit) {
  Task late = test::example_task(test::forward_camera());
  late.servo.gain_per_s = 3;
  late.servo.far_gain_per_s = 2;
  late.timing.latency_s = 0.5;
  const double most = *largest_gain_per_s({1. / 30, std::nullopt}, late.timing);
  ASSERT_LT(most, 0.5);
  Task slow = late;
  slow.timing = {};
  slow.servo.gain_per_s = most;
  slow.servo.far_gain_per_s = most;
  const Decision decision = decided(kFlight, late, std::nullopt);
  const auto slowly = decided(kFlight, slow, std::nullopt).wanted.vector();
  EXPECT_LT((decision.wanted.vector() - slowly).norm(), 1e-12);
  EXPECT_GT(decision.wanted.vector().norm(), 0.05);
  ASSERT_TRUE(decision.gain_per_s);
  EXPECT_NEAR(*decision.gain_per_s, most, 1e-12);
}

// A vehicle that drifts on and hardly answers is steered as one that is already there: NED velocity
// turned into its heading, its travel into the camera, forwards in time.
TEST(Timing, PredictsWhereAMeasuredDriftLeads) {
  for (const Mount& mount : {test::forward_camera(), test::down_camera()}) {
    Task task = test::example_task(mount);
    task.timing.latency_s = 0.5;
    task.timing.response = {1e6, 0.1, 1e6, 1e6};
    const Eigen::Vector3d drift(0.4, -0.3, 0.2);
    test::Flight there = kFlight;
    there.ned += 0.5 * drift;
    const auto ahead = decided(there, task, drift).wanted.vector();
    const auto now = decided(kFlight, task, drift).wanted.vector();
    task.timing.predict = Prediction::Measured;
    const Decision predicted = decided(kFlight, task, drift);
    EXPECT_EQ(predicted.predicted_s, 0.5);
    // What it answers in half a second: 2 m/s over 1e6 s, twice over.
    EXPECT_LT((predicted.wanted.vector() - ahead).norm(), 1e-5);
    EXPECT_GT((now - ahead).norm(), 0.02);
    EXPECT_EQ(decided(kFlight, task, std::nullopt).predicted_s, 0) << "nothing was measured";
  }
}

TEST(Timing, NamesItsPredictions) {
  EXPECT_STREQ(name(Prediction::Off), "off");
  EXPECT_STREQ(name(Prediction::Measured), "measured");
  EXPECT_STREQ(name(Prediction::Commanded), "commanded");
}

}  // namespace
}  // namespace kestrel
