#include "kestrel/link/autopilot_model.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samples.hpp"

namespace kestrel {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// The rules, the kinematic vehicle under them, and a clock; somebody talks to it.
struct Flight {
  explicit Flight(const AutopilotModelOptions& options = {}, double yaw = 0)
      : model(options), vehicle(at_start(options, yaw)) {}

  static VehicleTruth at_start(const AutopilotModelOptions& options, double yaw) {
    VehicleTruth truth;
    truth.position_ned_m.z() = options.starts_armed ? -10 : 0;
    truth.attitude.yaw = yaw;
    return truth;
  }

  std::vector<mavlink::Message> say(const mavlink::Message& message) {
    return messages(model.receive(mavlink::encode(message, {1, 191, sequence++}).bytes(),
                                  vehicle.truth(), now_s));
  }

  int command(std::uint16_t id, float p1 = 0, float p2 = 0, float p3 = 0, float p7 = 0) {
    mavlink::CommandLong command;
    command.command = id;
    command.param1 = p1;
    command.param2 = p2;
    command.param3 = p3;
    command.param7 = p7;
    command.target_system = 1;
    command.target_component = 1;
    const auto answers = say(command);
    EXPECT_EQ(answers.size(), 1u);
    const auto& ack = std::get<mavlink::CommandAck>(answers.at(0));
    EXPECT_EQ(ack.command, id);
    EXPECT_EQ(ack.target_component, 191);
    return ack.result;
  }

  int take_control() { return is_px4() ? command(176, 1, 6) : command(176, 1, 4); }
  bool is_px4() const { return model.mode() > 255; }

  void setpoint(const VelocityCommand& command, std::uint8_t frame = 8) {
    mavlink::SetPositionTarget s = velocity_setpoint(command, 0, {1, 1});
    s.coordinate_frame = frame;
    say(s);
  }

  void fly(double seconds) {
    for (int i = 0; i < int(std::lround(seconds * 100)); ++i) {
      now_s += 0.01;
      for (const auto& message : messages(model.tick(vehicle.truth(), now_s))) {
        told.push_back(message);
      }
      vehicle.move(model.reference(), 0.01);
    }
  }

  static std::vector<mavlink::Message> messages(const AutopilotModel::Frames& frames) {
    std::vector<mavlink::Message> all;
    for (const auto& frame : frames) {
      const mavlink::Decoded decoded = mavlink::decode(frame.bytes());
      all.push_back(std::get<mavlink::Packet>(decoded.content).message);
    }
    return all;
  }

  double speed() const { return vehicle.truth().velocity_ned_m_s.norm(); }

  AutopilotModel model;
  KinematicVehicle vehicle;
  double now_s = 0;
  std::uint8_t sequence = 0;
  std::vector<mavlink::Message> told;
};

AutopilotModelOptions options_for(Autopilot autopilot) {
  AutopilotModelOptions options;
  options.autopilot = autopilot;
  return options;
}

AutopilotModelOptions on_the_ground(Autopilot autopilot) {
  AutopilotModelOptions options = options_for(autopilot);
  options.starts_armed = false;
  return options;
}

class AutopilotModelOfBoth : public testing::TestWithParam<Autopilot> {
 protected:
  bool is_ardupilot() const { return GetParam() == Autopilot::ArduPilot; }
};
INSTANTIATE_TEST_SUITE_P(Autopilots, AutopilotModelOfBoth,
                         testing::Values(Autopilot::ArduPilot, Autopilot::Px4),
                         [](const auto& which) { return name(which.param); });

// Half a turn of yaw and a tilt of 20 degrees: only the yaw turns the velocities.
TEST_P(AutopilotModelOfBoth, TurnsTheHeadingFrameByTheYawAlone) {
  for (const double yaw : {0.0, 0.7, -2.5}) {
    Flight flight(options_for(GetParam()), yaw);
    VehicleTruth tilted = flight.vehicle.truth();
    tilted.attitude.pitch = 0.35;
    tilted.attitude.roll = -0.35;
    flight.vehicle = KinematicVehicle(tilted);
    flight.setpoint({});
    ASSERT_EQ(flight.take_control(), 0);
    flight.setpoint({1, 2, 0.5, -0.25});
    const Eigen::Vector3d expected(std::cos(yaw) - 2 * std::sin(yaw),
                                   std::sin(yaw) + 2 * std::cos(yaw), 0.5);
    EXPECT_LT((flight.model.reference().velocity_ned_m_s - expected).norm(), 1e-6);
    EXPECT_EQ(flight.model.reference().yaw_rate_rad_s, -0.25);
    EXPECT_EQ(flight.model.counts().obeyed, 1);
  }
}

TEST_P(AutopilotModelOfBoth, ObeysSetpointsInItsControlModeAlone) {
  Flight flight(options_for(GetParam()));
  flight.setpoint({1, 0, 0, 0});
  flight.fly(1);
  EXPECT_EQ(flight.speed(), 0);
  EXPECT_EQ(flight.model.counts().ignored, 1);
  flight.setpoint({1, 0, 0, 0});
  ASSERT_EQ(flight.take_control(), 0);
  flight.setpoint({1, 0, 0, 0});
  flight.fly(0.9);
  EXPECT_GT(flight.speed(), 0.8);
  flight.model.pilot_chooses(is_ardupilot() ? 5 : kPx4Hold, flight.now_s);
  flight.setpoint({1, 0, 0, 0});
  flight.fly(3);
  EXPECT_LT(flight.speed(), 1e-2);
}

// link.md: ArduPilot flies on for 3 s and is stopped after 4.1 s; PX4 leaves OFFBOARD after 1.0 s.
TEST_P(AutopilotModelOfBoth, StopsAfterItsOwnTimeOut) {
  Flight flight(options_for(GetParam()));
  flight.setpoint({});
  flight.take_control();
  flight.setpoint({2, 0, 0, 0});
  const double timeout_s = is_ardupilot() ? 3.0 : 1.0;
  flight.fly(timeout_s - 0.02);
  EXPECT_GT(flight.model.reference().velocity_ned_m_s.x(), 1.9);
  flight.fly(0.04);
  EXPECT_EQ(flight.model.reference().velocity_ned_m_s.norm(), 0);
  EXPECT_EQ(flight.model.mode(), is_ardupilot() ? kArduPilotGuided : kPx4Hold);
  flight.fly(1.1);
  EXPECT_LT(flight.speed(), 0.2);  // a tenth
}

TEST_P(AutopilotModelOfBoth, ObeysOrRefusesTheOtherBodyFrames) {
  Flight flight(options_for(GetParam()), M_PI / 2);
  flight.setpoint({});
  flight.take_control();
  flight.setpoint({0, 3, 0, 0}, 1);  // north, east, down
  EXPECT_LT((flight.model.reference().velocity_ned_m_s - Eigen::Vector3d(0, 3, 0)).norm(), 1e-6);
  flight.setpoint({1, 0, 0, 0}, 9);
  EXPECT_NEAR(flight.model.reference().velocity_ned_m_s.y(), is_ardupilot() ? 1 : 3, 1e-6);
  flight.setpoint({1, 0, 0, 0}, 12);
  EXPECT_NEAR(flight.model.reference().velocity_ned_m_s.norm(), is_ardupilot() ? 0 : 3, 1e-6);
  EXPECT_EQ(flight.model.counts().refused, is_ardupilot() ? 0 : 2);
}

TEST_P(AutopilotModelOfBoth, ANumberThatIsNotFiniteEndsArduPilotAndAnAxisOfPx4) {
  Flight flight(options_for(GetParam()));
  flight.setpoint({});
  flight.take_control();
  mavlink::SetPositionTarget bad = velocity_setpoint({1, 0, 0, 0}, 0, {1, 1});
  bad.yaw_rate_rad_s = kNan;
  flight.say(bad);
  EXPECT_EQ(flight.model.counts().not_finite, 1);
  EXPECT_EQ(flight.model.alive(), !is_ardupilot());
  EXPECT_EQ(flight.model.reference().velocity_ned_m_s.x(), is_ardupilot() ? 0 : 1);
  EXPECT_EQ(flight.model.reference().yaw_rate_rad_s, 0);
  flight.told.clear();
  flight.fly(2);
  EXPECT_EQ(flight.told.empty(), is_ardupilot());
}

TEST_P(AutopilotModelOfBoth, TakesOffFliesAndLands) {
  Flight flight(on_the_ground(GetParam()));
  const bool px4 = !is_ardupilot();
  if (px4) {
    EXPECT_EQ(flight.command(400, 1), 0);
    EXPECT_EQ(flight.command(176, 1, 4, 2), 0);
  } else {
    EXPECT_NE(flight.command(22, 0, 0, 0, 2), 0);  // neither armed nor in GUIDED
    EXPECT_EQ(flight.command(176, 1, 4), 0);
    EXPECT_NE(flight.command(22, 0, 0, 0, 2), 0);
    EXPECT_EQ(flight.command(400, 1), 0);
    EXPECT_EQ(flight.command(22, 0, 0, 0, 2.5), 0);
  }
  EXPECT_EQ(flight.model.landed(flight.vehicle.truth()), Landed::TakingOff);
  flight.fly(5);
  EXPECT_NEAR(flight.vehicle.truth().position_ned_m.z(), -2.5, 0.5);  // overshoots by v tau
  EXPECT_EQ(flight.model.landed(flight.vehicle.truth()), Landed::InAir);
  EXPECT_NE(flight.command(400, 0), 0);  // not in the air
  EXPECT_EQ(px4 ? flight.command(176, 1, 4, 6) : flight.command(176, 1, 9), 0);
  flight.fly(10);
  EXPECT_EQ(flight.vehicle.truth().position_ned_m.z(), 0);
  EXPECT_FALSE(flight.model.armed());
}

TEST(AutopilotModel, ASetpointBreaksArduPilotsTakeOffOff) {
  Flight flight(on_the_ground(Autopilot::ArduPilot));
  flight.command(176, 1, 4);
  flight.command(400, 1);
  flight.command(22, 0, 0, 0, 5);
  flight.fly(1);
  flight.setpoint({});
  flight.fly(5);
  EXPECT_GT(flight.vehicle.truth().position_ned_m.z(), -2);
}

TEST(AutopilotModel, Px4WantsTheStreamBeforeOffboard) {
  Flight flight(options_for(Autopilot::Px4));
  EXPECT_EQ(flight.command(176, 1, 6), 1);
  flight.setpoint({});
  flight.fly(1.1);
  EXPECT_EQ(flight.command(176, 1, 6), 1);
  flight.setpoint({});
  EXPECT_EQ(flight.command(176, 1, 6), 0);
  EXPECT_EQ(flight.model.mode(), kPx4Offboard);
}

TEST_P(AutopilotModelOfBoth, TellsOfItselfAsOftenAsItIsAsked) {
  Flight flight(options_for(GetParam()));
  flight.fly(2);
  const auto count = [&](auto what) {
    long n = 0;
    for (const auto& m : flight.told) n += std::holds_alternative<decltype(what)>(m) ? 1 : 0;
    return n;
  };
  EXPECT_EQ(count(mavlink::Heartbeat{}), 2);
  EXPECT_EQ(count(mavlink::AttitudeReport{}), 8);
  EXPECT_EQ(count(mavlink::ExtendedSysState{}), is_ardupilot() ? 0 : 4);
  EXPECT_EQ(flight.command(511, 30, 20000), 0);
  EXPECT_EQ(flight.command(511, 245, 500000), 0);
  EXPECT_NE(flight.command(511, 245, -1), 0);
  EXPECT_NE(flight.command(511, 24, 20000), 0);
  flight.told.clear();
  flight.fly(2);
  EXPECT_NEAR(double(count(mavlink::AttitudeReport{})), 100,
              13);  // the old interval runs out first
  EXPECT_GE(count(mavlink::ExtendedSysState{}), 4);
}

TEST_P(AutopilotModelOfBoth, TheBatteryPaysForTimeInTheAirOnly) {
  AutopilotModelOptions options = options_for(GetParam());
  options.battery.endurance_s = 20;
  for (const bool in_air : {true, false}) {
    options.starts_armed = in_air;
    Flight flight(options);
    flight.fly(4.5);
    std::vector<Battery> heard;
    for (const auto& message : flight.told) {
      if (const auto* s = std::get_if<mavlink::SysStatus>(&message)) {
        heard.push_back(battery_of(*s));
      }
    }
    ASSERT_EQ(heard.size(), 5u) << "once a second";
    // Told at 0.01 s, 1.01 s, ... of which the first step has no time before it.
    for (std::size_t i = 0; i < heard.size(); ++i) {
      EXPECT_NEAR(*heard[i].charge, in_air ? 1 - double(i) / 20 : 1, 0.006) << i;
      EXPECT_NEAR(*heard[i].current_a, in_air ? options.battery.flying_a : options.battery.idle_a,
                  1e-9);
    }
  }
}

TEST_P(AutopilotModelOfBoth, AnswersTheClockByItsOwn) {
  AutopilotModelOptions options = options_for(GetParam());
  options.boot_s = -1000;
  Flight flight(options);
  flight.now_s = 5;
  const auto answers = flight.say(mavlink::TimeSync{0, 77, 0, 0});
  ASSERT_EQ(answers.size(), 1u);
  EXPECT_EQ(std::get<mavlink::TimeSync>(answers[0]).tc1_ns, 1005000000000);
  EXPECT_EQ(std::get<mavlink::TimeSync>(answers[0]).ts1_ns, 77);
}

TEST(AutopilotModel, DoesNotListenToWhatIsForOthers) {
  Flight flight;
  mavlink::CommandLong command = mode_request(profile_of(Autopilot::ArduPilot), 4, {2, 1});
  EXPECT_TRUE(flight.say(command).empty());
  mavlink::SetPositionTarget s = velocity_setpoint({}, 0, {2, 1});
  flight.say(s);
  EXPECT_EQ(flight.model.counts().misaddressed, 2);
  EXPECT_EQ(flight.model.counts().setpoints, 0);
}

TEST(AutopilotModel, SurvivesAnyBytes) {
  test::Random random("autopilot model bytes");
  for (const Autopilot which : {Autopilot::ArduPilot, Autopilot::Px4}) {
    Flight flight(options_for(which));
    for (int i = 0; i < 3000; ++i) {
      const test::Buffer frame = test::random_frame(random);
      flight.model.receive(test::view(frame), flight.vehicle.truth(), i * 0.01);
      const auto& reference = flight.model.reference();
      ASSERT_TRUE(reference.velocity_ned_m_s.allFinite());
      ASSERT_TRUE(std::isfinite(reference.yaw_rate_rad_s));
    }
  }
}

TEST(AutopilotModelOptions, NameWhatIsOutOfRange) {
  AutopilotModelOptions empty;
  empty.battery.endurance_s = 0;
  EXPECT_THROW(AutopilotModel{empty}, std::invalid_argument);
  for (const auto member :
       {&AutopilotModelOptions::climb_m_s, &AutopilotModelOptions::sink_m_s,
        &AutopilotModelOptions::px4_takeoff_m, &AutopilotModelOptions::telemetry_hz}) {
    for (const double bad : {0.0, -1.0, double(kNan)}) {
      AutopilotModelOptions options;
      options.*member = bad;
      EXPECT_THROW(AutopilotModel{options}, std::invalid_argument);
    }
  }
}

}  // namespace
}  // namespace kestrel
