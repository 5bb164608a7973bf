#include "kestrel/link/switch_operator.hpp"

#include <gtest/gtest.h>

namespace kestrel {
namespace {

constexpr Recipient kSwitch{1, 192};

/// A switch that answers, or does not, by a clock of its own.
class Asked : public testing::Test {
 protected:
  /// The request that is sent now, 0 for none.
  int due() {
    const auto command = operator_.due(now_s_);
    if (!command) return 0;
    EXPECT_EQ(command->target_system, kSwitch.system_id);
    EXPECT_EQ(command->target_component, kSwitch.component_id);
    return command->command;
  }
  void answer(SwitchControl what, std::uint8_t result = 0, std::uint32_t word = 0) {
    mavlink::CommandAck ack;
    ack.command = std::uint16_t(what);
    ack.result = result;
    ack.result_param2 = std::int32_t(word);
    operator_.hear({{1, 192, 0}, ack}, now_s_);
  }
  void beat(const ControlWord& word) {
    mavlink::Heartbeat heartbeat;
    heartbeat.custom_mode = bits_of(word);
    operator_.hear({{1, 192, 0}, heartbeat}, now_s_);
  }
  /// How many requests are sent in so long, looked for fifty times a second.
  int sent_within(double s) {
    int count = 0;
    for (int i = 0; i < int(s * 50); ++i, now_s_ += 0.02) count += due() != 0 ? 1 : 0;
    return count;
  }
  std::string told() {
    std::string all;
    for (const std::string& words : operator_.take_words()) all += words + "\n";
    return all;
  }
  OperatorStatus status() const { return operator_.status(now_s_); }

  SwitchOperator operator_{kSwitch};
  double now_s_ = 100;
};

TEST_F(Asked, WhatIsGrantedIsAskedOnce) {
  operator_.take_over();
  EXPECT_EQ(due(), 31010);
  EXPECT_EQ(due(), 0) << "it was sent just now";
  now_s_ += 0.004;
  answer(SwitchControl::TakeOver, 0, bits_of({ControlState::TakenOver, std::nullopt}));
  EXPECT_EQ(sent_within(2), 0);
  EXPECT_TRUE(status().holds);
  EXPECT_EQ(told(),
            "the switch: take-over granted after 4 ms; taken over by the ground: nobody commands "
            "the vehicle: zeros\n");
  EXPECT_TRUE(operator_.owes());
  operator_.release();
  EXPECT_EQ(due(), 31012);
  answer(SwitchControl::Release);
  EXPECT_FALSE(operator_.owes());
  EXPECT_FALSE(status().holds);
}

TEST_F(Asked, NothingIsReleasedThatWasNotTaken) {
  operator_.release();
  EXPECT_EQ(due(), 0) << "it may be another ground station's";
}

TEST_F(Asked, ATakeOverWithoutAnAnswerIsGivenUpAndReleased) {
  operator_.take_over();
  std::vector<int> sent;
  for (int i = 0; i < 100 && (sent.empty() || sent.back() != 31012); ++i, now_s_ += 0.02) {
    EXPECT_EQ(status().holds, true) << i;
    if (const int request = due()) sent.push_back(request);
  }
  EXPECT_EQ(sent, (std::vector<int>{31010, 31010, 31010, 31010, 31010, 31012}))
      << "it may have been heard";
  EXPECT_FALSE(status().holds);
  EXPECT_NE(told().find("take-over: no answer"), std::string::npos);
  answer(SwitchControl::Release);
  EXPECT_FALSE(operator_.owes());
}

TEST_F(Asked, ATakeOverThatIsDeniedIsHeldNoMore) {
  operator_.take_over();
  due();
  answer(SwitchControl::TakeOver, 2);
  EXPECT_FALSE(status().holds);
  EXPECT_FALSE(operator_.owes());
  EXPECT_NE(told().find("denied (is this a link of role ground?)"), std::string::npos);
  EXPECT_EQ(due(), 0);
}

TEST_F(Asked, AStopIsAskedForUntilItIsAnsweredAndToldOnce) {
  operator_.stop();
  EXPECT_GE(sent_within(10), 80) << "each 0.1 s, when it is looked for each 0.02";
  EXPECT_EQ(told(), "the switch: emergency stop: no answer; it is asked again\n");
  EXPECT_EQ(status().open, "emergency stop");
  answer(SwitchControl::EmergencyStop);
  EXPECT_EQ(sent_within(1), 0);
  EXPECT_EQ(status().open, "");
}

TEST_F(Asked, AStopGoesBeforeAllElseAndReleasesWhatWasTaken) {
  operator_.take_over();
  due();
  operator_.stop();
  EXPECT_EQ(due(), 31013) << "at once";
  answer(SwitchControl::EmergencyStop);
  EXPECT_EQ(due(), 31012);
  answer(SwitchControl::Release);
  EXPECT_EQ(due(), 0);
  EXPECT_FALSE(status().holds);
}

TEST_F(Asked, AResetEndsTheAskingForAStop) {
  operator_.stop();
  due();
  operator_.reset();
  EXPECT_EQ(due(), 31014);
  answer(SwitchControl::EmergencyStop);
  EXPECT_EQ(sent_within(1), 4) << "an answer to the stop is none to the reset; it is given up";
  EXPECT_NE(told().find("reset: no answer\n"), std::string::npos);
}

TEST_F(Asked, AResetIsGivenUpThoughAReleaseIsStillAsked) {
  operator_.take_over();
  due();
  answer(SwitchControl::TakeOver);
  operator_.stop();
  operator_.reset();
  EXPECT_EQ(due(), 31014) << "before the release";
  EXPECT_GE(sent_within(5), 20);
  answer(SwitchControl::Release);
  EXPECT_EQ(sent_within(2), 0) << "it would end the stop of somebody else by now";
}

TEST_F(Asked, TheSwitchIsHeardByItsHeartbeats) {
  EXPECT_FALSE(status().is_heard);
  EXPECT_EQ(words(status()), "The switch is not heard.");
  beat({ControlState::Owned, LinkRole::Vision});
  EXPECT_TRUE(status().is_heard);
  EXPECT_EQ(words(status()), "The switch: vision commands the vehicle.");
  now_s_ += SwitchOperator::kSilence_s * 1.01;
  EXPECT_FALSE(status().is_heard);
}

TEST_F(Asked, OthersAreNotTheSwitch) {
  mavlink::Heartbeat heartbeat;
  heartbeat.custom_mode = 5;
  operator_.hear({{1, 1, 0}, heartbeat}, now_s_);
  EXPECT_FALSE(status().is_heard);
  operator_.stop();
  due();
  mavlink::CommandAck ack;
  ack.command = 31013;
  operator_.hear({{1, 1, 0}, ack}, now_s_);
  EXPECT_EQ(status().open, "emergency stop");
}

}  // namespace
}  // namespace kestrel
