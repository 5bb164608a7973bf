#include "kestrel/ground/hand_flight.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

const VelocityCommand kForward{0.5, 0, 0, 0.1};
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(HeldSticks, AskForNothingUntilAHandTakesThem) {
  HeldSticks sticks;
  sticks.push(kForward, 0);
  EXPECT_FALSE(sticks.are_held(0));
  EXPECT_TRUE(sticks.wanted(0).vector().isZero(0));
  sticks.grip(1);
  EXPECT_TRUE(sticks.are_held(1));
  EXPECT_TRUE(sticks.wanted(1).vector().isZero(0)) << "in their middle";
  sticks.push(kForward, 1.1);
  EXPECT_EQ(sticks.wanted(1.1).vector(), kForward.vector());
}

TEST(HeldSticks, AreLetGoWhenNothingFreshIsSaid) {
  HeldSticks sticks;
  sticks.grip(0);
  for (double t = 0.1; t < 2; t += 0.1) {
    sticks.push(kForward, t);
    EXPECT_TRUE(sticks.are_held(t + 0.99 * HeldSticks::kFresh_s));
  }
  const double silent_s = 1.9 + 1.01 * HeldSticks::kFresh_s + 0.01;
  EXPECT_FALSE(sticks.are_held(silent_s));
  EXPECT_TRUE(sticks.wanted(silent_s).vector().isZero(0));
  sticks.push(kForward, silent_s);
  EXPECT_FALSE(sticks.are_held(silent_s)) << "a value that comes late takes nothing up again";
  EXPECT_FALSE(sticks.are_held(kNaN));
}

TEST(HeldSticks, WhatIsNotFiniteLetsGo) {
  for (const double bad : {kNaN, kInf, -kInf}) {
    HeldSticks sticks;
    sticks.grip(0);
    sticks.push({0, 0, bad, 0}, 0);
    EXPECT_FALSE(sticks.are_held(0)) << bad;
  }
}

/// The decision of a law at a stamp that wants to go right.
Decision of_law(double stamp_s) {
  Decision decision;
  decision.wanted = decision.command = {0, 0.7, 0, 0};
  decision.state = CommandState::Servo;
  decision.next.stamp_s = stamp_s;
  decision.next.sent = decision.command;
  decision.next.seen_stamp_s = stamp_s;
  decision.next.timing.period_s = 0.04;
  return decision;
}

/// The commands of frames at 25 Hz from hover on, while the sticks ask for this.
Decision after_frames(int frames, const VelocityCommand& wanted, const CommandLimits& limits) {
  DecisionState before;
  before.stamp_s = 0;
  Decision decision;
  for (int i = 1; i <= frames; ++i) {
    decision = by_hand(of_law(i * 0.04), wanted, before, limits);
    before = decision.next;
  }
  return decision;
}

TEST(ByHand, TheSticksTakeThePlaceOfTheLaw) {
  const Decision decision = after_frames(100, kForward, CommandLimits{});
  EXPECT_EQ(decision.command.vector(), kForward.vector());
  EXPECT_EQ(decision.state, CommandState::Sticks) << "it rests on nothing that was seen";
  EXPECT_EQ(decision.wanted.right_m_s, 0.7) << "what the law wants is still to be seen";
  EXPECT_FALSE(decision.next.seen_stamp_s) << "nothing to hold when the target is lost";
  EXPECT_EQ(decision.next.timing.period_s, 0.04);
}

TEST(ByHand, NeverGoesBeyondTheLimitsAndKeepsTheDirection) {
  const CommandLimits limits;
  for (const double huge : {3.0, 1e6, 1e300}) {
    const Eigen::Vector4d v = after_frames(200, {huge, huge / 2, 0, 0}, limits).command.vector();
    EXPECT_LE((v.cwiseAbs() - limits.speed.vector()).maxCoeff(), 0) << huge;
    EXPECT_NEAR(v[0], 2 * v[1], 1e-9) << huge;
    EXPECT_GT(v[0], 1.9) << huge;
  }
}

TEST(ByHand, ChangesNoFasterThanTheLimitsAllow) {
  const CommandLimits limits;
  const double first = after_frames(1, {10, 0, 0, 0}, limits).command.forward_m_s;
  EXPECT_NEAR(first, limits.acceleration.forward_m_s * 0.04, 1e-12);
  DecisionState before;
  before.stamp_s = 0;
  const Decision late = by_hand(of_law(60), {10, 0, 0, 0}, before, limits);
  EXPECT_NEAR(late.command.forward_m_s, limits.acceleration.forward_m_s * HeldSticks::kFresh_s,
              1e-12)
      << "a minute without a frame is no leave to jump";
}

TEST(ByHand, NonsenseIsZero) {
  for (const double bad : {kNaN, kInf}) {
    EXPECT_TRUE(after_frames(5, {bad, 0, 0, 0}, CommandLimits{}).command.vector().isZero(0));
  }
  EXPECT_TRUE(
      by_hand(of_law(1), kForward, DecisionState{}, CommandLimits{}).command.vector().isZero(0))
      << "the first frame has no time before it";
  DecisionState before = after_frames(50, kForward, CommandLimits{}).next;
  Decision nowhen = of_law(9);
  nowhen.next.stamp_s.reset();
  EXPECT_TRUE(by_hand(nowhen, kForward, before, CommandLimits{}).command.vector().isZero(0));
}

TEST(Stopped, LeavesNothingToResume) {
  const Decision still = stopped(of_law(5));
  EXPECT_TRUE(still.command.vector().isZero(0));
  EXPECT_TRUE(still.next.sent.vector().isZero(0));
  EXPECT_EQ(still.state, CommandState::Hover);
  EXPECT_EQ(still.next.stamp_s, 5);
  EXPECT_FALSE(still.next.seen_stamp_s);
  EXPECT_EQ(still.wanted.right_m_s, 0.7);
  EXPECT_EQ(still.next.timing.period_s, 0.04) << "how fast the loop is outlives it";
}

}  // namespace
}  // namespace kestrel
