#include "kestrel/link/handshake.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace kestrel {
namespace {

using testing::HasSubstr;

/// A vehicle that does at once what is asked, as long as it answers; and the clock.
struct Story {
  explicit Story(Autopilot which, const HandshakeOptions& options = {})
      : handshake(options), autopilot(which) {
    vehicle.heartbeat.autopilot = which == Autopilot::ArduPilot ? 3 : 12;
    vehicle.heartbeat.type = 4;
    vehicle.heartbeat.base_mode = 0x80;
    vehicle.heartbeat.custom_mode = which == Autopilot::ArduPilot ? 5 : kPx4Hold;
    vehicle.landed = Landed::InAir;
    vehicle.down_m = -10;
  }

  /// So many steps of 0.1 s, each heard by the other side.
  void run(double seconds) {
    for (int i = 0; i < int(std::lround(seconds * 10)); ++i) {
      now_s += 0.1;
      if (beats) vehicle.heard_s = now_s;
      wishes.push_back(handshake.wish());
      const auto command = handshake.tick(vehicle, {1, 1}, now_s);
      if (!command) continue;
      sent.push_back(*command);
      if (answers) obey(*command);
    }
  }

  /// Asks for control, and lets so many seconds go by.
  void ask(double seconds) {
    handshake.request_control();
    run(seconds);
  }

  void obey(const mavlink::CommandLong& command) {
    mavlink::CommandAck ack;
    ack.command = command.command;
    ack.result = command.command == refuses ? 2 : 0;
    handshake.acknowledge(ack, now_s);
    if (ack.result != 0 || !acts) return;
    if (command.command == kCommandArm) vehicle.heartbeat.base_mode |= 0x80;
    if (command.command == kCommandMode) {
      vehicle.heartbeat.custom_mode =
          autopilot == Autopilot::ArduPilot
              ? std::uint32_t(command.param2)
              : px4_mode(std::uint32_t(command.param2), std::uint32_t(command.param3));
    }
    if (command.command == kCommandTakeOff || vehicle.heartbeat.custom_mode == kPx4TakeOff) {
      vehicle.landed = Landed::TakingOff;
    }
  }

  void stand_on_the_ground() {
    vehicle.heartbeat.base_mode = 0;
    vehicle.landed = Landed::OnGround;
    vehicle.down_m = 0.2;
  }

  std::vector<int> commands() const {
    std::vector<int> all;
    for (const auto& command : sent) all.push_back(command.command);
    return all;
  }

  Handshake handshake;
  Autopilot autopilot;
  VehicleState vehicle;
  double now_s = 0;
  bool beats = true;
  bool answers = true;
  bool acts = true;
  int refuses = -1;
  std::vector<mavlink::CommandLong> sent;
  std::vector<StreamWish> wishes;
};

HandshakeOptions may_arm(double takeoff_m) {
  HandshakeOptions options;
  options.allow_arming = true;
  options.takeoff_m = takeoff_m;
  return options;
}

class HandshakeWithBoth : public testing::TestWithParam<Autopilot> {
 protected:
  AutopilotProfile profile() const { return profile_of(GetParam()); }
  std::uint32_t other_mode() const { return GetParam() == Autopilot::ArduPilot ? 0 : px4_mode(3); }
};
INSTANTIATE_TEST_SUITE_P(Autopilots, HandshakeWithBoth,
                         testing::Values(Autopilot::ArduPilot, Autopilot::Px4),
                         [](const auto& which) { return name(which.param); });

TEST_P(HandshakeWithBoth, AsksForNothingByItself) {
  Story story(GetParam());
  EXPECT_EQ(story.handshake.state(), HandshakeState::Unseen);
  story.run(10);
  EXPECT_EQ(story.handshake.state(), HandshakeState::Seen);
  EXPECT_TRUE(story.sent.empty());
  EXPECT_EQ(story.handshake.wish(), StreamWish::Silence);
}

TEST_P(HandshakeWithBoth, TakesControlWithOneCommand) {
  Story story(GetParam());
  story.ask(3);
  EXPECT_EQ(story.commands(), std::vector<int>{176});
  EXPECT_EQ(story.vehicle.heartbeat.custom_mode, profile().control_mode);
  EXPECT_EQ(story.handshake.state(), HandshakeState::InControl);
  EXPECT_EQ(story.handshake.wish(), StreamWish::Commands);
  story.ask(1);
  EXPECT_EQ(story.sent.size(), 1u);
}

// PX4 refuses OFFBOARD without a stream of setpoints before; no command may fly before it obeys.
TEST_P(HandshakeWithBoth, StreamsZerosWhileItAsks) {
  Story story(GetParam());
  story.handshake.request_control();
  double zeros_s = 0;
  while (story.sent.empty() && story.now_s < 5) {
    story.run(0.1);
    if (story.handshake.wish() == StreamWish::Zeros) zeros_s += 0.1;
  }
  EXPECT_GE(zeros_s, profile().stream_first_s);
  for (const StreamWish wish : story.wishes) EXPECT_NE(wish, StreamWish::Commands);
}

TEST_P(HandshakeWithBoth, AsksFourTimesAndThenSaysThatNobodyAnswered) {
  Story story(GetParam());
  story.answers = false;
  story.ask(60);
  EXPECT_EQ(story.sent.size(), 4u);
  EXPECT_EQ(story.handshake.state(), HandshakeState::Refused);
  EXPECT_EQ(story.handshake.words(), "mode: no answer to 4 tries");
  EXPECT_EQ(story.handshake.wish(), StreamWish::Silence);
}

TEST_P(HandshakeWithBoth, ALostAnswerDoesNotMatterWhenTheModeIsReported) {
  Story story(GetParam());
  story.answers = false;
  story.ask(1.5);
  ASSERT_FALSE(story.sent.empty());
  story.vehicle.heartbeat.custom_mode = profile().control_mode;
  story.run(0.1);
  EXPECT_EQ(story.handshake.state(), HandshakeState::InControl);
}

TEST_P(HandshakeWithBoth, SaysThatItWasDeniedOrNotDone) {
  Story denied(GetParam());
  denied.refuses = kCommandMode;
  denied.ask(10);
  EXPECT_EQ(denied.handshake.state(), HandshakeState::Refused);
  EXPECT_EQ(denied.handshake.words(), "mode: denied");
  EXPECT_EQ(denied.sent.size(), 1u);
  Story idle(GetParam());
  idle.acts = false;
  idle.ask(10);
  EXPECT_EQ(idle.handshake.words(), "mode: accepted, but not done");
}

TEST_P(HandshakeWithBoth, ThePilotTakesOverAtOnceAndIsNeverOverruled) {
  Story story(GetParam());
  story.ask(3);
  ASSERT_EQ(story.handshake.state(), HandshakeState::InControl);
  story.vehicle.heartbeat.custom_mode = other_mode();
  story.run(0.1);
  EXPECT_EQ(story.handshake.state(), HandshakeState::Released);
  EXPECT_EQ(story.handshake.wish(), StreamWish::Silence);
  EXPECT_THAT(story.handshake.words(), HasSubstr("by somebody else"));
  const std::size_t asked = story.sent.size();
  story.run(60);
  // Nor does the mode alone bring us back.
  story.vehicle.heartbeat.custom_mode = profile().control_mode;
  story.run(10);
  EXPECT_EQ(story.handshake.state(), HandshakeState::Released);
  EXPECT_EQ(story.sent.size(), asked);
  story.vehicle.heartbeat.custom_mode = other_mode();
  story.ask(3);
  EXPECT_EQ(story.handshake.state(), HandshakeState::InControl);
}

TEST_P(HandshakeWithBoth, ThePilotTakesOverWhileControlIsAskedFor) {
  Story story(GetParam());
  story.answers = false;
  story.ask(1.5);
  const std::size_t asked = story.sent.size();
  story.vehicle.heartbeat.custom_mode = other_mode();
  story.run(10);
  EXPECT_EQ(story.handshake.state(), HandshakeState::Released);
  EXPECT_EQ(story.sent.size(), asked);
}

TEST_P(HandshakeWithBoth, AVehicleThatIsDisarmedIsTheirs) {
  Story story(GetParam());
  story.ask(3);
  story.vehicle.heartbeat.base_mode = 0;
  story.run(0.1);
  EXPECT_EQ(story.handshake.state(), HandshakeState::Released);
}

TEST_P(HandshakeWithBoth, NeverArmsWithoutLeave) {
  for (const bool armed : {false, true}) {
    Story story(GetParam());
    story.stand_on_the_ground();
    if (armed) story.vehicle.heartbeat.base_mode = 0x80;
    story.ask(10);
    EXPECT_TRUE(story.sent.empty());
    EXPECT_EQ(story.handshake.state(), HandshakeState::Refused);
    EXPECT_THAT(story.handshake.words(), HasSubstr("allow_arming"));
    EXPECT_THAT(story.handshake.words(), HasSubstr(armed ? "ground" : "not armed"));
  }
  Story story(GetParam(), may_arm(0));
  story.stand_on_the_ground();
  story.ask(10);
  EXPECT_TRUE(story.sent.empty());
  EXPECT_THAT(story.handshake.words(), HasSubstr("takeoff_m"));
  HandshakeOptions sly;
  sly.takeoff_m = 5;
  EXPECT_THROW(Handshake{sly}, std::invalid_argument);
}

TEST_P(HandshakeWithBoth, TakesOffInTheOrderOfTheAutopilotAndThenHasControl) {
  Story story(GetParam(), may_arm(5));
  story.stand_on_the_ground();
  story.ask(5);
  const bool ardupilot = GetParam() == Autopilot::ArduPilot;
  EXPECT_EQ(story.commands(),
            ardupilot ? (std::vector<int>{176, 400, 22}) : (std::vector<int>{400, 176}));
  EXPECT_EQ(story.handshake.state(), HandshakeState::Climbing);
  // A setpoint would break ArduPilot's take-off off.
  EXPECT_EQ(story.handshake.wish(), StreamWish::Silence);
  story.vehicle.landed = Landed::InAir;
  story.vehicle.down_m = 0.2 - 4.4;
  story.run(1);
  EXPECT_EQ(story.handshake.state(), HandshakeState::Climbing);
  story.vehicle.down_m = 0.2 - 4.6;
  if (!ardupilot) story.vehicle.heartbeat.custom_mode = kPx4Hold;
  story.run(2);
  EXPECT_EQ(story.handshake.state(), HandshakeState::InControl);
  EXPECT_EQ(story.vehicle.heartbeat.custom_mode, profile().control_mode);
}

TEST_P(HandshakeWithBoth, GivesUpATakeOffThatDoesNotClimb) {
  Story story(GetParam(), may_arm(5));
  story.stand_on_the_ground();
  story.ask(70);
  EXPECT_EQ(story.handshake.state(), HandshakeState::Refused);
  EXPECT_THAT(story.handshake.words(), HasSubstr("take-off"));
}

TEST_P(HandshakeWithBoth, LandsOnlyWithLeaveAndInControl) {
  Story plain(GetParam());
  plain.ask(3);
  plain.handshake.request_landing();
  plain.run(3);
  EXPECT_EQ(plain.handshake.state(), HandshakeState::InControl);
  EXPECT_THAT(plain.handshake.words(), HasSubstr("allow_arming"));
  Story story(GetParam(), may_arm(0));
  story.handshake.request_landing();
  story.run(1);
  EXPECT_TRUE(story.sent.empty());
  story.ask(3);
  story.handshake.request_landing();
  story.run(1);
  EXPECT_EQ(story.vehicle.heartbeat.custom_mode, profile().landing_mode);
  EXPECT_EQ(story.handshake.state(), HandshakeState::Landing);
  EXPECT_EQ(story.handshake.wish(), StreamWish::Silence);
  story.vehicle.landed = Landed::OnGround;
  story.run(0.1);
  EXPECT_EQ(story.handshake.state(), HandshakeState::Released);
}

TEST_P(HandshakeWithBoth, GivesControlBack) {
  Story story(GetParam());
  story.ask(3);
  story.handshake.release();
  if (GetParam() == Autopilot::Px4) {
    EXPECT_EQ(story.handshake.wish(), StreamWish::Zeros);
    story.run(1);
    EXPECT_EQ(story.vehicle.heartbeat.custom_mode, kPx4Hold);
  }
  EXPECT_EQ(story.handshake.state(), HandshakeState::Released);
  EXPECT_EQ(story.handshake.wish(), StreamWish::Silence);
}

TEST_P(HandshakeWithBoth, AnAutopilotThatIsNoLongerHeardIsNotControlled) {
  Story story(GetParam());
  story.ask(3);
  story.beats = false;
  story.run(4.9);
  EXPECT_EQ(story.handshake.state(), HandshakeState::InControl);
  story.run(0.3);
  EXPECT_EQ(story.handshake.state(), HandshakeState::Unseen);
  EXPECT_EQ(story.handshake.wish(), StreamWish::Silence);
  story.beats = true;
  story.run(5);
  EXPECT_EQ(story.handshake.state(), HandshakeState::Seen);
}

TEST_P(HandshakeWithBoth, AsksForControlOnceTheAutopilotIsHeard) {
  Story story(GetParam());
  story.handshake.request_control();
  EXPECT_FALSE(story.handshake.tick(std::nullopt, {1, 1}, 0));
  EXPECT_EQ(story.handshake.state(), HandshakeState::Unseen);
  story.run(3);
  EXPECT_EQ(story.handshake.state(), HandshakeState::InControl);
}

TEST_P(HandshakeWithBoth, LeavesTheModeToThePilotWhenToldTo) {
  HandshakeOptions options;
  options.take_control = false;
  Story story(GetParam(), options);
  story.handshake.request_control();
  EXPECT_THAT(story.handshake.words(), HasSubstr("take_control"));
  story.run(3);
  EXPECT_EQ(story.handshake.state(), HandshakeState::Seen);
  // PX4's pilot can choose OFFBOARD only while the stream runs.
  EXPECT_EQ(story.handshake.wish(),
            GetParam() == Autopilot::Px4 ? StreamWish::Zeros : StreamWish::Silence);
  for (int i = 0; i < 3; ++i) {
    story.vehicle.heartbeat.custom_mode = profile().control_mode;
    story.run(0.1);
    EXPECT_EQ(story.handshake.state(), HandshakeState::InControl);
    story.vehicle.heartbeat.custom_mode = other_mode();
    story.run(0.1);
    EXPECT_EQ(story.handshake.state(), HandshakeState::Seen);
  }
  EXPECT_TRUE(story.sent.empty());
}

TEST(Handshake, RefusesAVehicleWhoseRulesAreNotKnown) {
  Story story(Autopilot::ArduPilot);
  story.vehicle.heartbeat.type = 1;  // a plane
  story.ask(5);
  EXPECT_TRUE(story.sent.empty());
  EXPECT_EQ(story.handshake.state(), HandshakeState::Refused);
}

TEST(HandshakeOptions, NameWhatIsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto member : {&HandshakeOptions::takeoff_m, &HandshakeOptions::confirm_s,
                            &HandshakeOptions::climb_s, &HandshakeOptions::lost_s}) {
    for (const double bad : {-1.0, nan}) {
      HandshakeOptions options = may_arm(0);
      options.*member = bad;
      EXPECT_THROW(options.check(), std::invalid_argument);
    }
  }
}

}  // namespace
}  // namespace kestrel
