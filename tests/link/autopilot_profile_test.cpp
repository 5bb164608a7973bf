#include "kestrel/link/autopilot_profile.hpp"

#include <gtest/gtest.h>

namespace kestrel {
namespace {

constexpr Recipient kVehicle{7, 1};

mavlink::Heartbeat heartbeat(int autopilot, int type) {
  mavlink::Heartbeat beat;
  beat.autopilot = std::uint8_t(autopilot);
  beat.type = std::uint8_t(type);
  return beat;
}

TEST(AutopilotProfile, IsRecognisedFromTheHeartbeat) {
  for (const int type : {2, 3, 4, 13, 14, 15, 29, 35}) {
    EXPECT_EQ(autopilot_of(heartbeat(3, type)), Autopilot::ArduPilot);
    EXPECT_EQ(autopilot_of(heartbeat(12, type)), Autopilot::Px4);
    EXPECT_FALSE(autopilot_of(heartbeat(8, type)));  // no flight controller
    EXPECT_FALSE(autopilot_of(heartbeat(0, type)));
  }
  for (const int type : {0, 1, 6, 10, 11, 18, 19}) {  // plane, ground station, rover, boat, ...
    EXPECT_FALSE(autopilot_of(heartbeat(3, type)));
    EXPECT_FALSE(autopilot_of(heartbeat(12, type)));
  }
}

TEST(AutopilotProfile, AsksArduPilotByTheNumberOfTheMode) {
  const auto message = mode_request(profile_of(Autopilot::ArduPilot), kArduPilotGuided, kVehicle);
  EXPECT_EQ(message.command, 176);
  EXPECT_EQ(message.param1, 1);
  EXPECT_EQ(message.param2, 4);
  EXPECT_EQ(message.param3, 0);
  EXPECT_EQ(message.target_system, 7);
  EXPECT_EQ(message.target_component, 1);
  EXPECT_EQ(profile_of(Autopilot::ArduPilot).control_mode, 4u);
  EXPECT_EQ(profile_of(Autopilot::ArduPilot).landing_mode, 9u);
}

TEST(AutopilotProfile, AsksPx4ByMainAndSubMode) {
  const AutopilotProfile px4 = profile_of(Autopilot::Px4);
  EXPECT_EQ(px4.control_mode, 0x00060000u);
  const auto offboard = mode_request(px4, px4.control_mode, kVehicle);
  EXPECT_EQ(offboard.param1, 1);
  EXPECT_EQ(offboard.param2, 6);
  EXPECT_EQ(offboard.param3, 0);
  const auto land = mode_request(px4, px4.landing_mode, kVehicle);
  EXPECT_EQ(land.param2, 4);
  EXPECT_EQ(land.param3, 6);
}

// link.md: measured on both.
TEST(AutopilotProfile, KnowsTheTimeOuts) {
  EXPECT_EQ(profile_of(Autopilot::ArduPilot).setpoint_timeout_s, 3);
  EXPECT_EQ(profile_of(Autopilot::Px4).setpoint_timeout_s, 1);
  EXPECT_EQ(profile_of(Autopilot::ArduPilot).stream_first_s, 0);
  EXPECT_EQ(profile_of(Autopilot::Px4).stream_first_s, 1);
}

TEST(AutopilotProfile, TakesOffArmsAndAsksForMessages) {
  const auto ardupilot = takeoff_request(profile_of(Autopilot::ArduPilot), 2.5, kVehicle);
  EXPECT_EQ(ardupilot.command, 22);
  EXPECT_EQ(ardupilot.param7, 2.5F);
  const auto px4 = takeoff_request(profile_of(Autopilot::Px4), 2.5, kVehicle);
  EXPECT_EQ(px4.command, 176);
  EXPECT_EQ(px4.param2, 4);
  EXPECT_EQ(px4.param3, 2);
  const auto arm = arm_request(kVehicle);
  EXPECT_EQ(arm.command, 400);
  EXPECT_EQ(arm.param1, 1);
  EXPECT_EQ(arm.param2, 0);  // 21196 would force it
  const auto interval = interval_request(30, 50, kVehicle);
  EXPECT_EQ(interval.command, 511);
  EXPECT_EQ(interval.param1, 30);
  EXPECT_EQ(interval.param2, 20000);
}

TEST(AutopilotProfile, SaysModesAndCommandsInWords) {
  EXPECT_EQ(mode_name(Autopilot::ArduPilot, 4), "GUIDED");
  EXPECT_EQ(mode_name(Autopilot::ArduPilot, 99), "mode 99");
  EXPECT_EQ(mode_name(Autopilot::Px4, kPx4Offboard), "OFFBOARD");
  EXPECT_EQ(mode_name(Autopilot::Px4, kPx4Hold), "AUTO.LOITER");
  EXPECT_EQ(command_name(400), "arm");
  EXPECT_EQ(command_name(12), "command 12");
  EXPECT_STREQ(name(Autopilot::ArduPilot), "ardupilot");
  EXPECT_STREQ(name(Autopilot::Px4), "px4");
}

TEST(AutopilotProfile, ReadsTheSafetySwitchOfTheHeartbeat) {
  mavlink::Heartbeat beat;
  EXPECT_FALSE(is_armed(beat));
  beat.base_mode = 0x80;
  EXPECT_TRUE(is_armed(beat));
  beat.base_mode = 0x7F;
  EXPECT_FALSE(is_armed(beat));
}

}  // namespace
}  // namespace kestrel
