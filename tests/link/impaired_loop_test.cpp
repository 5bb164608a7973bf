// The closed loop over bad lines, in virtual time: it converges, or it stops safely. Safely is: an
// exact zero within the deadman time and one period after the last fresh command, never a number
// that is not finite, never a velocity beyond the envelope.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "link/flown_loop.hpp"

namespace kestrel::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kDegree = M_PI / 180;

bool is_zero(const VelocityCommand& command) { return command.vector().isZero(0); }

double period_s(const FlownLoopOptions& options) { return 1 / options.switching.rate_hz; }

/// The longest a datagram is under way.
double longest_s(const ImpairmentOptions& line) {
  return line.delay_s + line.jitter_s + line.holdback_s;
}

/// What holds on any line: nothing that reached the vehicle was not finite, of another kind, or
/// over the envelope (to the rounding of a float).
void expect_harmless(const FlownLoop& loop, const FlownLoopOptions& options) {
  EXPECT_EQ(loop.received.not_finite, 0);
  EXPECT_EQ(loop.received.unsupported, 0);
  const Eigen::Array4d limit = options.switching.envelope.speed.vector().array() * (1 + 1e-6);
  for (const ObeyedCommand& obeyed : loop.obeyed) {
    ASSERT_TRUE(is_finite(obeyed.command)) << obeyed.time_s;
    ASSERT_TRUE((obeyed.command.vector().array().abs() <= limit).all()) << obeyed.time_s;
  }
}

/// The latest time at which a velocity that is not zero was obeyed; -1 for none.
double last_motion_s(const FlownLoop& loop, double before_s = kInfinity) {
  double last_s = -1;
  for (const ObeyedCommand& obeyed : loop.obeyed) {
    if (!is_zero(obeyed.command) && obeyed.time_s < before_s) last_s = obeyed.time_s;
  }
  return last_s;
}

/// When an exact zero was first obeyed after a time, with zeros only until `until_s`.
double first_lasting_zero_s(const FlownLoop& loop, double until_s) {
  const double motion_s = last_motion_s(loop, until_s);
  for (const ObeyedCommand& obeyed : loop.obeyed) {
    if (obeyed.time_s > motion_s && is_zero(obeyed.command)) return obeyed.time_s;
  }
  return kInfinity;
}

FlownLoopOptions options_named(const std::string& name) {
  FlownLoopOptions options;
  options.switching = loop_switch();
  options.name = name;
  return options;
}

TEST(ImpairedLoop, ConvergesOnAPerfectLine) {
  const FlownLoopOptions options = options_named("perfect");
  const FlownLoop loop = flown_loop(options);
  expect_harmless(loop, options);
  EXPECT_GT(goal_error_m(loop.states.front()), 3);
  EXPECT_LT(goal_error_m(loop.end()), 0.1);
  EXPECT_LT(std::abs(loop.end().yaw), 2 * kDegree);
}

// Half of the datagrams lost leave 15 commands a second, and the 20 Hz stream of the switch carries
// them on: the loop's gain of some 1 /s does not feel it.
TEST(ImpairedLoop, ConvergesWithUpToHalfOfAllDatagramsLost) {
  for (const double loss : {0.0, 0.1, 0.2, 0.3, 0.4, 0.5}) {
    FlownLoopOptions options = options_named("loss " + std::to_string(loss));
    options.to_switch = poor_radio(loss);
    const FlownLoop loop = flown_loop(options);
    expect_harmless(loop, options);
    EXPECT_LT(goal_error_m(loop.end()), 0.1) << loss;
    EXPECT_LT(std::abs(loop.end().yaw), 2 * kDegree) << loss;
    EXPECT_NEAR(double(loop.to_switch.lost) / double(loop.to_switch.sent), loss, 0.08);
  }
}

TEST(ImpairedLoop, ConvergesWithABadLineBehindTheSwitchToo) {
  FlownLoopOptions options = options_named("both");
  options.to_switch = options.to_vehicle = poor_radio(0.3);
  const FlownLoop loop = flown_loop(options);
  EXPECT_LT(goal_error_m(loop.end()), 0.1);
  EXPECT_LT(std::abs(loop.end().yaw), 2 * kDegree);
}

TEST(ImpairedLoop, EachImpairmentByItselfIsHarmless) {
  const auto flies = [](const char* name, double ImpairmentOptions::*option, double value) {
    FlownLoopOptions options = options_named(name);
    options.to_switch.*option = value;
    const FlownLoop loop = flown_loop(options);
    expect_harmless(loop, options);
    EXPECT_LT(goal_error_m(loop.end()), 0.1) << name;
  };
  flies("loss", &ImpairmentOptions::loss, 0.5);
  flies("duplication", &ImpairmentOptions::duplication, 1);
  flies("corruption", &ImpairmentOptions::corruption, 0.5);
  flies("truncation", &ImpairmentOptions::truncation, 0.5);
  flies("reordering", &ImpairmentOptions::reordering, 0.5);
  flies("delay", &ImpairmentOptions::delay_s, 0.2);
  flies("jitter", &ImpairmentOptions::jitter_s, 0.2);
}

TEST(ImpairedLoop, StopsWhereNothingGetsThroughAtAll) {
  for (double ImpairmentOptions::*option :
       {&ImpairmentOptions::loss, &ImpairmentOptions::corruption, &ImpairmentOptions::truncation}) {
    FlownLoopOptions options = options_named("nothing");
    options.to_switch.*option = 1;
    options.duration_s = 10;
    const FlownLoop loop = flown_loop(options);
    expect_harmless(loop, options);
    EXPECT_EQ(last_motion_s(loop), -1);
    EXPECT_EQ((loop.end().position_m - loop.states.front().position_m).norm(), 0);
  }
}

TEST(ImpairedLoop, ACutLineIsAnExactZeroWithinTheDeadmanTime) {
  for (const bool poor : {false, true}) {
    FlownLoopOptions options = options_named("cut");
    if (poor) options.to_switch = poor_radio(0.2);
    options.cut_from_s = 3;
    options.duration_s = 8;
    const FlownLoop loop = flown_loop(options);
    expect_harmless(loop, options);
    EXPECT_GT(last_motion_s(loop), 2.5);  // it was moving
    const double zero_s = first_lasting_zero_s(loop, kInfinity);
    const double bound_s = loop.last_fresh_s + longest_s(options.to_switch) +
                           options.switching.deadman_s + period_s(options);
    EXPECT_LE(zero_s, bound_s + 2 * kLoopStep_s);
    std::printf("poor %d: first zero %.3f s after the last fresh command\n", int(poor),
                zero_s - loop.last_fresh_s);
    // And never silence in place of zero: to the end, at the rate.
    EXPECT_GE(loop.obeyed.back().time_s, options.duration_s - period_s(options) - 2 * kLoopStep_s);
  }
}

TEST(ImpairedLoop, AFrozenPictureBehindALiveSenderIsAnExactZeroTooAndStaysIt) {
  for (const bool poor : {false, true}) {
    FlownLoopOptions options = options_named("frozen");
    if (poor) options.to_switch = poor_radio(0.2);
    options.frozen_from_s = 3;
    options.duration_s = 8;
    const FlownLoop loop = flown_loop(options);
    expect_harmless(loop, options);
    const double zero_s = first_lasting_zero_s(loop, kInfinity);
    const double bound_s = loop.last_fresh_s + longest_s(options.to_switch) +
                           options.switching.deadman_s + period_s(options);
    EXPECT_LE(zero_s, bound_s + 2 * kLoopStep_s);
    EXPECT_GT(last_motion_s(loop), 2.5);
  }
}

TEST(ImpairedLoop, AfterACutItFliesOnToTheGoal) {
  FlownLoopOptions options = options_named("mended");
  options.to_switch = poor_radio(0.2);
  options.cut_from_s = 3;
  options.cut_until_s = 9;
  options.duration_s = 46;
  const FlownLoop loop = flown_loop(options);
  expect_harmless(loop, options);
  EXPECT_LT(first_lasting_zero_s(loop, 9), 4);
  EXPECT_LT(goal_error_m(loop.end()), 0.1);
}

TEST(ImpairedLoop, TheLossOfTheTargetStopsTheVehicleOverABadLine) {
  FlownLoopOptions options = options_named("blind");
  options.to_switch = poor_radio(0.5);
  options.blind_from_s = 3;
  options.duration_s = 10;
  const FlownLoop loop = flown_loop(options);
  expect_harmless(loop, options);
  // The loop's own failsafe: exact zeros a second after the target was seen.
  const double bound_s = 3 + LossOptions{}.hover_after_s + longest_s(options.to_switch) +
                         options.switching.deadman_s + period_s(options);
  EXPECT_LE(first_lasting_zero_s(loop, kInfinity), bound_s);
  EXPECT_LT(loop.end().velocity_m_s.norm(), 0.01);
}

TEST(ImpairedLoop, TheSameSeedIsTheSameFlight) {
  FlownLoopOptions options = options_named("repeat");
  options.to_switch = options.to_vehicle = poor_radio(0.3);
  options.duration_s = 10;
  const FlownLoop one = flown_loop(options);
  const FlownLoop two = flown_loop(options);
  EXPECT_EQ(one.end().position_m, two.end().position_m);
  EXPECT_EQ(one.obeyed.size(), two.obeyed.size());
  options.name = "another";
  EXPECT_NE(one.end().position_m, flown_loop(options).end().position_m);
}

}  // namespace
}  // namespace kestrel::test
