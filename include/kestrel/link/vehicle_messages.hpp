#pragma once

#include <array>
#include <cstdint>

// MAVLink messages (mavlink.io, "common"): what a vehicle says of itself. Units are in the names;
// fields after "extensions" are missing in the frames of older senders, and are then zero.
namespace kestrel::mavlink {

/// HEARTBEAT (0): who is there. The defaults are a companion computer at work.
struct Heartbeat {
  std::uint32_t custom_mode = 0;
  std::uint8_t type = 18;      // MAV_TYPE_ONBOARD_CONTROLLER
  std::uint8_t autopilot = 8;  // MAV_AUTOPILOT_INVALID: not a flight controller
  std::uint8_t base_mode = 0;
  std::uint8_t system_status = 4;  // MAV_STATE_ACTIVE
  std::uint8_t mavlink_version = 3;
};

/// SYS_STATUS (1): health of the sensors, battery and link.
struct SysStatus {
  std::uint32_t sensors_present = 0;
  std::uint32_t sensors_enabled = 0;
  std::uint32_t sensors_health = 0;
  std::uint16_t load_permille = 0;
  std::uint16_t battery_mv = 0;
  std::int16_t battery_10ma = 0;
  std::uint16_t drop_rate_cpercent = 0;
  std::uint16_t errors_comm = 0;
  std::uint16_t errors_count1 = 0;
  std::uint16_t errors_count2 = 0;
  std::uint16_t errors_count3 = 0;
  std::uint16_t errors_count4 = 0;
  std::int8_t battery_percent = 0;
  // extensions
  std::uint32_t sensors_present_extended = 0;
  std::uint32_t sensors_enabled_extended = 0;
  std::uint32_t sensors_health_extended = 0;
};

/// EXTENDED_SYS_STATE (245): on the ground, in the air, between.
struct ExtendedSysState {
  std::uint8_t vtol_state = 0;
  std::uint8_t landed_state = 0;
};

/// AUTOPILOT_VERSION (148): what the autopilot is and can do.
struct AutopilotVersion {
  std::uint64_t capabilities = 0;
  std::uint64_t uid = 0;
  std::uint32_t flight_sw_version = 0;
  std::uint32_t middleware_sw_version = 0;
  std::uint32_t os_sw_version = 0;
  std::uint32_t board_version = 0;
  std::uint16_t vendor_id = 0;
  std::uint16_t product_id = 0;
  std::array<std::uint8_t, 8> flight_custom_version{};
  std::array<std::uint8_t, 8> middleware_custom_version{};
  std::array<std::uint8_t, 8> os_custom_version{};
  // extensions
  std::array<std::uint8_t, 18> uid2{};
};

/// STATUSTEXT (253): words for the operator; `text` ends at its first zero byte, or nowhere.
struct StatusText {
  std::uint8_t severity = 0;
  std::array<char, 50> text{};
  // extensions
  std::uint16_t id = 0;
  std::uint8_t chunk_seq = 0;
};

/// SERVO_OUTPUT_RAW (36): pulse lengths of the outputs.
struct ServoOutputRaw {
  std::uint32_t time_us = 0;
  std::uint16_t servo1_us = 0;
  std::uint16_t servo2_us = 0;
  std::uint16_t servo3_us = 0;
  std::uint16_t servo4_us = 0;
  std::uint16_t servo5_us = 0;
  std::uint16_t servo6_us = 0;
  std::uint16_t servo7_us = 0;
  std::uint16_t servo8_us = 0;
  std::uint8_t port = 0;
  // extensions
  std::uint16_t servo9_us = 0;
  std::uint16_t servo10_us = 0;
  std::uint16_t servo11_us = 0;
  std::uint16_t servo12_us = 0;
  std::uint16_t servo13_us = 0;
  std::uint16_t servo14_us = 0;
  std::uint16_t servo15_us = 0;
  std::uint16_t servo16_us = 0;
};

}  // namespace kestrel::mavlink
