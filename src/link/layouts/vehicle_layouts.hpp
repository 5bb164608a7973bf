#pragma once

#include "kestrel/link/vehicle_messages.hpp"

#include "layout.hpp"

namespace kestrel::mavlink {

template <>
struct Layout<Heartbeat> {
  static constexpr std::string_view kName = "HEARTBEAT";
  static constexpr std::uint32_t kId = 0;
  static constexpr std::uint8_t kCrcExtra = 50;
  static constexpr std::size_t kLength = 9;
  static constexpr auto kFields = std::make_tuple(
      field("custom_mode", &Heartbeat::custom_mode), field("type", &Heartbeat::type),
      field("autopilot", &Heartbeat::autopilot), field("base_mode", &Heartbeat::base_mode),
      field("system_status", &Heartbeat::system_status),
      field("mavlink_version", &Heartbeat::mavlink_version));
};
static_assert(as_published<Heartbeat>());

template <>
struct Layout<SysStatus> {
  static constexpr std::string_view kName = "SYS_STATUS";
  static constexpr std::uint32_t kId = 1;
  static constexpr std::uint8_t kCrcExtra = 124;
  static constexpr std::size_t kLength = 31;
  static constexpr std::size_t kLongest = 43;
  static constexpr auto kFields = std::make_tuple(
      field("onboard_control_sensors_present", &SysStatus::sensors_present),
      field("onboard_control_sensors_enabled", &SysStatus::sensors_enabled),
      field("onboard_control_sensors_health", &SysStatus::sensors_health),
      field("load", &SysStatus::load_permille), field("voltage_battery", &SysStatus::battery_mv),
      field("current_battery", &SysStatus::battery_10ma),
      field("drop_rate_comm", &SysStatus::drop_rate_cpercent),
      field("errors_comm", &SysStatus::errors_comm),
      field("errors_count1", &SysStatus::errors_count1),
      field("errors_count2", &SysStatus::errors_count2),
      field("errors_count3", &SysStatus::errors_count3),
      field("errors_count4", &SysStatus::errors_count4),
      field("battery_remaining", &SysStatus::battery_percent));
  static constexpr auto kExtensions = std::make_tuple(
      field("onboard_control_sensors_present_extended", &SysStatus::sensors_present_extended),
      field("onboard_control_sensors_enabled_extended", &SysStatus::sensors_enabled_extended),
      field("onboard_control_sensors_health_extended", &SysStatus::sensors_health_extended));
};
static_assert(as_published<SysStatus>());

template <>
struct Layout<ExtendedSysState> {
  static constexpr std::string_view kName = "EXTENDED_SYS_STATE";
  static constexpr std::uint32_t kId = 245;
  static constexpr std::uint8_t kCrcExtra = 130;
  static constexpr std::size_t kLength = 2;
  static constexpr auto kFields =
      std::make_tuple(field("vtol_state", &ExtendedSysState::vtol_state),
                      field("landed_state", &ExtendedSysState::landed_state));
};
static_assert(as_published<ExtendedSysState>());

template <>
struct Layout<AutopilotVersion> {
  static constexpr std::string_view kName = "AUTOPILOT_VERSION";
  static constexpr std::uint32_t kId = 148;
  static constexpr std::uint8_t kCrcExtra = 178;
  static constexpr std::size_t kLength = 60;
  static constexpr std::size_t kLongest = 78;
  static constexpr auto kFields = std::make_tuple(
      field("capabilities", &AutopilotVersion::capabilities), field("uid", &AutopilotVersion::uid),
      field("flight_sw_version", &AutopilotVersion::flight_sw_version),
      field("middleware_sw_version", &AutopilotVersion::middleware_sw_version),
      field("os_sw_version", &AutopilotVersion::os_sw_version),
      field("board_version", &AutopilotVersion::board_version),
      field("vendor_id", &AutopilotVersion::vendor_id),
      field("product_id", &AutopilotVersion::product_id),
      field("flight_custom_version", &AutopilotVersion::flight_custom_version),
      field("middleware_custom_version", &AutopilotVersion::middleware_custom_version),
      field("os_custom_version", &AutopilotVersion::os_custom_version));
  static constexpr auto kExtensions = std::make_tuple(field("uid2", &AutopilotVersion::uid2));
};
static_assert(as_published<AutopilotVersion>());

template <>
struct Layout<StatusText> {
  static constexpr std::string_view kName = "STATUSTEXT";
  static constexpr std::uint32_t kId = 253;
  static constexpr std::uint8_t kCrcExtra = 83;
  static constexpr std::size_t kLength = 51;
  static constexpr std::size_t kLongest = 54;
  static constexpr auto kFields =
      std::make_tuple(field("severity", &StatusText::severity), field("text", &StatusText::text));
  static constexpr auto kExtensions =
      std::make_tuple(field("id", &StatusText::id), field("chunk_seq", &StatusText::chunk_seq));
};
static_assert(as_published<StatusText>());

template <>
struct Layout<ServoOutputRaw> {
  static constexpr std::string_view kName = "SERVO_OUTPUT_RAW";
  static constexpr std::uint32_t kId = 36;
  static constexpr std::uint8_t kCrcExtra = 222;
  static constexpr std::size_t kLength = 21;
  static constexpr std::size_t kLongest = 37;
  static constexpr auto kFields = std::make_tuple(
      field("time_usec", &ServoOutputRaw::time_us), field("servo1_raw", &ServoOutputRaw::servo1_us),
      field("servo2_raw", &ServoOutputRaw::servo2_us),
      field("servo3_raw", &ServoOutputRaw::servo3_us),
      field("servo4_raw", &ServoOutputRaw::servo4_us),
      field("servo5_raw", &ServoOutputRaw::servo5_us),
      field("servo6_raw", &ServoOutputRaw::servo6_us),
      field("servo7_raw", &ServoOutputRaw::servo7_us),
      field("servo8_raw", &ServoOutputRaw::servo8_us), field("port", &ServoOutputRaw::port));
  static constexpr auto kExtensions =
      std::make_tuple(field("servo9_raw", &ServoOutputRaw::servo9_us),
                      field("servo10_raw", &ServoOutputRaw::servo10_us),
                      field("servo11_raw", &ServoOutputRaw::servo11_us),
                      field("servo12_raw", &ServoOutputRaw::servo12_us),
                      field("servo13_raw", &ServoOutputRaw::servo13_us),
                      field("servo14_raw", &ServoOutputRaw::servo14_us),
                      field("servo15_raw", &ServoOutputRaw::servo15_us),
                      field("servo16_raw", &ServoOutputRaw::servo16_us));
};
static_assert(as_published<ServoOutputRaw>());

}  // namespace kestrel::mavlink
