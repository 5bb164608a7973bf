#include "kestrel/link/autopilot_adapter.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "adapter_flight.hpp"

namespace kestrel {
namespace {

using test::AdapterFlight;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

AutopilotModelOptions rules_of(Autopilot autopilot) {
  AutopilotModelOptions rules;
  rules.autopilot = autopilot;
  return rules;
}

class AdapterWithBoth : public testing::TestWithParam<Autopilot> {
 protected:
  AdapterFlight in_control(const AutopilotOptions& options = {}) const {
    AdapterFlight flight(options, rules_of(GetParam()));
    flight.fly(5);
    EXPECT_EQ(flight.control(), HandshakeState::InControl) << flight.adapter.status(0).words;
    return flight;
  }
  bool is_px4() const { return GetParam() == Autopilot::Px4; }
};
INSTANTIATE_TEST_SUITE_P(Autopilots, AdapterWithBoth,
                         testing::Values(Autopilot::ArduPilot, Autopilot::Px4),
                         [](const auto& which) { return name(which.param); });

/// Setpoints that are not exact zeros, from a time on.
long moving_setpoints(const AdapterFlight& flight, double from_s) {
  long n = 0;
  for (std::size_t i = 0; i < flight.wire.size(); ++i) {
    const auto* s = std::get_if<mavlink::SetPositionTarget>(&flight.wire[i].message);
    if (s == nullptr || flight.wire_s[i] < from_s) continue;
    if (!velocity_of(*s)->vector().isZero(0)) ++n;
  }
  return n;
}

TEST_P(AdapterWithBoth, TakesControlAndTheVehicleFliesAsCommanded) {
  AdapterFlight flight = in_control();
  flight.fly(2);
  EXPECT_NEAR(flight.vehicle.truth().velocity_ned_m_s.x(), 1, 0.01);
  EXPECT_EQ(flight.model.counts().refused + flight.model.counts().not_finite, 0);
  EXPECT_EQ(flight.model.counts().malformed, 0);
}

TEST_P(AdapterWithBoth, StreamsAtItsOwnRateWhateverTheFrames) {
  AdapterFlight flight = in_control();
  const auto before = flight.adapter.status(0).counts.setpoints;
  flight.fly(10);
  EXPECT_NEAR(double(flight.adapter.status(0).counts.setpoints - before), 200, 1);
  // Each carries the capture of its frame: 30 ms before the decision, and at most a frame older.
  for (std::size_t i = 0; i < flight.wire.size(); ++i) {
    const auto* s = std::get_if<mavlink::SetPositionTarget>(&flight.wire[i].message);
    if (s == nullptr || velocity_of(*s)->vector().isZero(0)) continue;
    const double age_s = flight.wire_s[i] - s->time_boot_ms / 1000.0;
    EXPECT_GE(age_s, 0.049);  // 30 ms before the decision, 20 ms on the line
    EXPECT_LE(age_s, 0.105);
  }
}

// No new frame: zeros on the wire within 0.5 s of the last capture and one period.
TEST_P(AdapterWithBoth, ZerosWithinTheDeadmanAndOnePeriodWhenTheFramesFreeze) {
  for (const bool repeats : {false, true}) {
    AdapterFlight flight = in_control();
    const double frozen_s = flight.now_s;
    flight.sees = false;
    for (int i = 0; i < 100; ++i) {
      // A frozen picture behind a living thread: the same stamp again and again.
      if (repeats) flight.adapter.decide({5, 0, 0, 0}, frozen_s - 0.03, flight.now_s);
      flight.step();
    }
    constexpr double kLine_s = 0.02;
    constexpr double kStep_s = 0.01;
    EXPECT_EQ(moving_setpoints(flight, frozen_s + 0.5 + 0.05 + kLine_s + kStep_s), 0);
    EXPECT_LT(flight.model.reference().velocity_ned_m_s.norm(), 1e-12);
  }
}

TEST_P(AdapterWithBoth, FallsSilentAfterTheZerosSoThatTheAutopilotsOwnFailsafeActs) {
  AdapterFlight flight = in_control();
  flight.sees = false;
  flight.fly(4);
  const auto& counts = flight.model.counts();
  const long setpoints = counts.setpoints;
  flight.fly(4);
  EXPECT_EQ(counts.setpoints, setpoints);
  EXPECT_LT(flight.speed(), 0.01);
  if (is_px4()) {
    EXPECT_EQ(flight.model.mode(), kPx4Hold);
    // The failsafe is a change of mode by somebody else: nothing is asked for again.
    flight.sees = true;
    flight.fly(5);
    EXPECT_EQ(flight.control(), HandshakeState::Released);
    EXPECT_EQ(flight.model.mode(), kPx4Hold);
  }
}

TEST_P(AdapterWithBoth, SendsZerosForEverWhenAsked) {
  AutopilotOptions options;
  options.stream.then = AfterZeros::Zeros;
  AdapterFlight flight = in_control(options);
  flight.sees = false;
  flight.fly(20);
  EXPECT_EQ(flight.control(), HandshakeState::InControl);
  const long before = flight.model.counts().obeyed;
  flight.fly(1);
  EXPECT_GE(flight.model.counts().obeyed - before, 19);
}

TEST_P(AdapterWithBoth, TheHeartbeatStopsWithTheWork) {
  AdapterFlight flight = in_control();
  const double stuck_s = flight.now_s;
  flight.sees = false;
  flight.fly(10);
  double last_s = 0;
  for (std::size_t i = 0; i < flight.wire.size(); ++i) {
    if (std::holds_alternative<mavlink::Heartbeat>(flight.wire[i].message)) {
      last_s = flight.wire_s[i];
    }
  }
  EXPECT_LE(last_s, stuck_s + 1.05);
  EXPECT_GE(last_s, stuck_s - 1.05);
}

// A frozen picture behind a living thread is no work.
TEST_P(AdapterWithBoth, TheHeartbeatStopsWhileAFrozenFrameIsDecidedAgain) {
  AdapterFlight flight = in_control();
  const double frozen_s = flight.now_s;
  flight.sees = false;
  for (int i = 0; i < 500; ++i) {
    flight.adapter.decide({1, 0, 0, 0}, frozen_s - 0.03, flight.now_s);
    flight.step();
  }
  const auto beats = flight.adapter.status(0).counts.heartbeats;
  flight.adapter.decide({1, 0, 0, 0}, frozen_s - 0.03, flight.now_s);
  flight.fly(3);
  EXPECT_EQ(flight.adapter.status(0).counts.heartbeats, beats);
}

TEST_P(AdapterWithBoth, BeatsOnceASecondAsTheCompanionOfTheVehicle) {
  AutopilotModelOptions rules = rules_of(GetParam());
  rules.me = {42, 1};
  AdapterFlight flight({}, rules);
  flight.fly(10.5);
  EXPECT_NEAR(double(flight.sent<mavlink::Heartbeat>().size()), 10.5, 1);
  EXPECT_EQ(flight.wire.back().envelope.system_id, 42);
  EXPECT_EQ(flight.wire.back().envelope.component_id, 191);
  EXPECT_EQ(flight.control(), HandshakeState::InControl);
  for (const auto& s : flight.sent<mavlink::SetPositionTarget>()) EXPECT_EQ(s.target_system, 42);
}

TEST_P(AdapterWithBoth, ThePilotsSwitchEndsEverySetpointAtOnce) {
  AdapterFlight flight = in_control();
  flight.model.pilot_chooses(is_px4() ? px4_mode(3) : 0, flight.now_s);
  const double switched_s = flight.now_s;
  flight.fly(1.2);  // until the next heartbeat and the line
  EXPECT_EQ(flight.control(), HandshakeState::Released);
  const long setpoints = flight.model.counts().setpoints;
  const std::size_t commands = flight.sent<mavlink::CommandLong>().size();
  flight.fly(30);
  EXPECT_EQ(flight.model.counts().setpoints, setpoints);
  EXPECT_EQ(flight.sent<mavlink::CommandLong>().size(), commands);
  EXPECT_EQ(moving_setpoints(flight, switched_s + 1.1), 0);
}

TEST_P(AdapterWithBoth, WhatIsNotFiniteNeverLeaves) {
  AdapterFlight flight = in_control();
  flight.command = {kNan, 0, 0, std::numeric_limits<double>::infinity()};
  flight.fly(3);
  EXPECT_EQ(flight.model.counts().not_finite, 0);
  EXPECT_TRUE(flight.model.alive());
  EXPECT_LT(flight.speed(), 0.01);
  for (const auto& s : flight.sent<mavlink::SetPositionTarget>()) EXPECT_TRUE(is_finite(s));
}

TEST_P(AdapterWithBoth, GivesControlBackWithZerosAsItsLastWord) {
  AdapterFlight flight = in_control();
  flight.adapter.release(flight.now_s);
  flight.fly(0.49);
  EXPECT_FALSE(flight.adapter.released());
  flight.fly(2);
  EXPECT_TRUE(flight.adapter.released());
  EXPECT_EQ(flight.model.mode(), is_px4() ? kPx4Hold : kArduPilotGuided);
  const auto setpoints = flight.sent<mavlink::SetPositionTarget>();
  EXPECT_TRUE(velocity_of(setpoints.back())->vector().isZero(0));
  const std::size_t before = setpoints.size();
  flight.fly(5);
  EXPECT_EQ(flight.sent<mavlink::SetPositionTarget>().size(), before);
  EXPECT_LT(flight.speed(), 0.01);
}

// Released before the first frame was decided: nothing is asked for any more.
TEST_P(AdapterWithBoth, HearsNoDecisionAfterTheRelease) {
  AdapterFlight flight({}, rules_of(GetParam()));
  flight.sees = false;
  flight.fly(2);
  flight.adapter.release(flight.now_s);
  flight.sees = true;
  flight.fly(5);
  EXPECT_TRUE(flight.adapter.released());
  EXPECT_EQ(flight.adapter.status(0).decided.decided, 0);
  EXPECT_NE(flight.model.mode(), is_px4() ? kPx4Offboard : kArduPilotGuided);
  EXPECT_EQ(moving_setpoints(flight, 0), 0);
}

// It has forgotten how often it was to report.
TEST_P(AdapterWithBoth, AsksAnAutopilotThatStartsAnewForItsTelemetryAgain) {
  AdapterFlight flight = in_control();
  AutopilotModelOptions rules = rules_of(GetParam());
  rules.boot_s = flight.now_s;
  flight.model = AutopilotModel(rules);
  flight.fly(8);
  EXPECT_GE(flight.adapter.status(0).clock_jumps, 1);
  const auto before = flight.adapter.status(0).telemetry.attitudes;
  flight.fly(2);
  EXPECT_GT(flight.adapter.status(0).telemetry.attitudes - before, 90);  // 50 Hz; by itself 4
}

TEST_P(AdapterWithBoth, TakesNoDeviceForTheAutopilot) {
  AdapterFlight flight({}, rules_of(GetParam()));
  mavlink::Heartbeat beat;
  beat.autopilot = 8;  // MAV_AUTOPILOT_INVALID
  flight.adapter.receive(mavlink::encode(beat, {7, 1, 0}).bytes(), flight.now_s);
  flight.fly(5);
  EXPECT_EQ(flight.control(), HandshakeState::InControl) << flight.adapter.status(0).words;
}

TEST_P(AdapterWithBoth, AVehicleThatIsNoLongerHeardGetsZerosAndThenNothing) {
  AdapterFlight flight = in_control();
  flight.beats = false;
  const double lost_s = flight.now_s;
  flight.fly(12);
  EXPECT_EQ(flight.control(), HandshakeState::Unseen);
  EXPECT_EQ(moving_setpoints(flight, lost_s + 5.2), 0);
  const auto last = flight.sent<mavlink::SetPositionTarget>().back();
  EXPECT_TRUE(velocity_of(last)->vector().isZero(0));
}

TEST_P(AdapterWithBoth, TakesOffOnlyWithLeaveAndThenFlies) {
  AutopilotModelOptions ground = rules_of(GetParam());
  ground.starts_armed = false;
  AdapterFlight refused({}, ground);
  refused.fly(5);
  EXPECT_EQ(refused.control(), HandshakeState::Refused);
  EXPECT_FALSE(refused.model.armed());
  EXPECT_EQ(refused.model.counts().setpoints, 0);
  AutopilotOptions options;
  options.handshake.allow_arming = true;
  options.handshake.takeoff_m = 3;
  AdapterFlight flight(options, ground);
  flight.fly(15);
  EXPECT_EQ(flight.control(), HandshakeState::InControl) << flight.adapter.status(0).words;
  EXPECT_LT(flight.vehicle.truth().position_ned_m.z(), -2);
  EXPECT_NEAR(flight.vehicle.truth().velocity_ned_m_s.x(), 1, 0.01);
  flight.adapter.request_landing();
  flight.fly(12);
  EXPECT_EQ(flight.control(), HandshakeState::Released);
  EXPECT_FALSE(flight.model.armed());
}

TEST_P(AdapterWithBoth, KnowsTheClockAndTheAttitudeAtTheTimeOfAnImage) {
  AutopilotModelOptions rules = rules_of(GetParam());
  rules.boot_s = 400;
  AdapterFlight flight({}, rules);
  flight.command = {0, 0, 0, 0.5};
  flight.fly(8);
  const AdapterStatus status = flight.adapter.status(flight.now_s);
  ASSERT_TRUE(status.clock);
  EXPECT_LE(std::abs(status.clock->offset_s + 400), status.clock->error_s + 1e-6);
  EXPECT_LT(status.clock->error_s, 0.03);
  const double image_s = flight.now_s - 0.05;
  const auto attitude = flight.adapter.attitude_at(image_s);
  ASSERT_TRUE(attitude);
  // The turn is steady by now; the error of the clock is at most 5 ms of it, and the steps 10 ms.
  const double yaw = flight.vehicle.truth().attitude.yaw - 0.5 * 0.05;
  EXPECT_NEAR(attitude->yaw, yaw, 0.5 * 0.016);
  EXPECT_EQ(status.telemetry.misdated, 0);
  // 50 Hz were asked for.
  EXPECT_GT(status.telemetry.attitudes, 200);
}

// Who only looks on must not disturb who flies: not even PX4, which wants a stream before OFFBOARD.
TEST_P(AdapterWithBoth, AnObserverKnowsTheVehicleAndNeverFliesIt) {
  AutopilotOptions options;
  options.part = AdapterPart::Observer;
  options.component_id = 100;
  options.handshake.take_control = false;  // a pilot would stream for PX4 from the start
  AdapterFlight flight(options, rules_of(GetParam()));
  flight.fly(3);
  flight.model.pilot_chooses(profile_of(GetParam()).control_mode, flight.now_s);  // somebody flies
  flight.fly(0.5);
  EXPECT_TRUE(flight.adapter.attitude_at(flight.now_s - 0.05));
  EXPECT_TRUE(flight.adapter.motion_at(flight.now_s - 0.15));
  EXPECT_TRUE(flight.adapter.status(flight.now_s).clock);
  EXPECT_TRUE(flight.sent<mavlink::SetPositionTarget>().empty());
  for (const auto& command : flight.sent<mavlink::CommandLong>()) {
    EXPECT_EQ(command.command, kCommandInterval);
  }
  flight.adapter.release(flight.now_s);
  EXPECT_TRUE(flight.adapter.released());
}

TEST_P(AdapterWithBoth, TheSetpointOfATickIsTold) {
  AdapterFlight flight = in_control();
  const std::size_t before = flight.sent<mavlink::SetPositionTarget>().size();
  int told = 0;
  for (int i = 0; i < 100; ++i) {
    flight.step();
    const auto& setpoint = flight.adapter.ticked_setpoint();
    if (!setpoint) continue;
    ++told;
    EXPECT_EQ(setpoint->state, StreamState::Fresh);
    EXPECT_GE(flight.now_s - setpoint->stamp_s, 0.03 - 1e-9);  // decided 30 ms after the capture
    EXPECT_LE(flight.now_s - setpoint->stamp_s, 0.03 + 0.05);  // and a frame is 33 ms
  }
  EXPECT_NEAR(told, 20, 1);  // 20 Hz for a second
  EXPECT_NEAR(double(flight.sent<mavlink::SetPositionTarget>().size() - before), told, 2);
}

TEST_P(AdapterWithBoth, AnswersQuestionsAboutItsClock) {
  AutopilotAdapter adapter;
  const auto question = mavlink::encode(mavlink::TimeSync{0, 99, 0, 0}, {255, 190, 0});
  const auto answers = adapter.receive(question.bytes(), 12.5);
  ASSERT_EQ(answers.size(), 1u);
  const auto decoded = mavlink::decode(answers[0].bytes());
  const auto& message = std::get<mavlink::Packet>(decoded.content).message;
  EXPECT_EQ(std::get<mavlink::TimeSync>(message).tc1_ns, 12500000000);
}

// Acknowledgements, heartbeats and telemetry of another system move nothing.
TEST_P(AdapterWithBoth, ListensToOneVehicleAlone) {
  AdapterFlight flight = in_control();
  mavlink::Heartbeat beat;
  beat.autopilot = is_px4() ? 12 : 3;
  beat.type = 4;
  beat.custom_mode = 9;
  for (const std::uint8_t system : {std::uint8_t(2), std::uint8_t(255), std::uint8_t(0)}) {
    flight.adapter.receive(mavlink::encode(beat, {system, 1, 0}).bytes(), flight.now_s);
  }
  flight.adapter.receive(mavlink::encode(beat, {1, 100, 0}).bytes(), flight.now_s);  // a camera
  flight.step();
  EXPECT_EQ(flight.control(), HandshakeState::InControl);
  EXPECT_EQ(flight.adapter.status(0).counts.foreign, 4);
}

TEST_P(AdapterWithBoth, SurvivesAnyBytesAndNeverSendsWhatIsNotFinite) {
  test::Random random("adapter bytes");
  AdapterFlight flight = in_control();
  for (int i = 0; i < 3000; ++i) {
    test::Buffer bytes = test::random_frame(random);
    if (i % 3 == 0) bytes[std::size_t(random.integer(0, int(bytes.size()) - 1))] ^= 0x10;
    // Also as if the vehicle had said it.
    if (i % 3 == 1) {
      bytes = test::copy(
          mavlink::encode(test::random_message(random), {1, 1, std::uint8_t(i)}).bytes());
    }
    flight.adapter.receive(test::view(bytes), flight.now_s);
    flight.step();
  }
  for (const auto& s : flight.sent<mavlink::SetPositionTarget>()) {
    ASSERT_TRUE(is_finite(s));
    ASSERT_TRUE(velocity_of(s));
  }
}

TEST(AutopilotOptions, NameWhatIsOutOfRange) {
  for (const auto member :
       {&AutopilotOptions::rate_hz, &AutopilotOptions::attitude_hz, &AutopilotOptions::position_hz,
        &AutopilotOptions::alive_s, &AutopilotOptions::farewell_s}) {
    for (const double bad : {-1.0, 1e9, kNan}) {
      AutopilotOptions options;
      options.*member = bad;
      EXPECT_THROW(AutopilotAdapter{options}, std::invalid_argument);
    }
  }
  AutopilotOptions options;
  options.component_id = 0;
  EXPECT_THROW(AutopilotAdapter{options}, std::invalid_argument);
}

}  // namespace
}  // namespace kestrel
