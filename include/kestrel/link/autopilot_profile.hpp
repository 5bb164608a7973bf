#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "kestrel/link/command_messages.hpp"
#include "kestrel/link/setpoint.hpp"
#include "kestrel/link/vehicle_messages.hpp"

namespace kestrel {

/// The autopilots whose rules are known (MAV_AUTOPILOT of their heartbeats: 3 and 12).
enum class Autopilot { ArduPilot, Px4 };

/// "ardupilot", "px4".
const char* name(Autopilot autopilot);

/// The commands of MAVLink that are used (MAV_CMD).
constexpr std::uint16_t kCommandLand = 21;
constexpr std::uint16_t kCommandTakeOff = 22;
constexpr std::uint16_t kCommandMode = 176;
constexpr std::uint16_t kCommandArm = 400;
constexpr std::uint16_t kCommandInterval = 511;

/// "arm", "mode", "take-off", "land", "message interval" or "command 123".
std::string command_name(std::uint16_t command);

/// custom_mode of a heartbeat. ArduPilot counts its modes (ArduCopter/mode.h); PX4 has a main mode
/// in bits 16 to 23 and a sub-mode in bits 24 to 31 (px4_custom_mode.h).
constexpr std::uint32_t px4_mode(std::uint32_t main, std::uint32_t sub = 0) {
  return main << 16 | sub << 24;
}
constexpr std::uint32_t kArduPilotGuided = 4;
constexpr std::uint32_t kArduPilotLand = 9;
constexpr std::uint32_t kPx4Offboard = px4_mode(6);
constexpr std::uint32_t kPx4TakeOff = px4_mode(4, 2);
constexpr std::uint32_t kPx4Hold = px4_mode(4, 3);
constexpr std::uint32_t kPx4Land = px4_mode(4, 6);

/// What must be known of an autopilot to fly it by setpoints.
struct AutopilotProfile {
  Autopilot autopilot = Autopilot::ArduPilot;
  std::uint32_t control_mode = kArduPilotGuided;  // the mode that obeys setpoints
  std::uint32_t landing_mode = kArduPilotLand;
  /// The mode control is given back to; empty: it stays in the control mode, where it holds its
  /// place without setpoints, until the pilot chooses another.
  std::optional<std::uint32_t> hold_mode;
  double stream_first_s = 0;      // setpoints must have run so long before the mode is asked for
  double setpoint_timeout_s = 3;  // without setpoints for so long it stops obeying the last
  bool setpoint_ends_takeoff = true;  // one that comes while it climbs breaks the take-off off
};

AutopilotProfile profile_of(Autopilot autopilot);

/// The autopilot that a heartbeat is from; empty for one that is not known, and for what is no
/// helicopter and no multicopter (MAV_TYPE 2, 3, 4, 13, 14, 15, 29, 35), which obeys other rules.
std::optional<Autopilot> autopilot_of(const mavlink::Heartbeat& heartbeat);

/// "GUIDED", "OFFBOARD", or "mode 27".
std::string mode_name(Autopilot autopilot, std::uint32_t custom_mode);

/// True for the bit MAV_MODE_FLAG_SAFETY_ARMED.
bool is_armed(const mavlink::Heartbeat& heartbeat);

/// MAV_CMD_DO_SET_MODE for a custom mode.
mavlink::CommandLong mode_request(const AutopilotProfile& profile, std::uint32_t custom_mode,
                                  const Recipient& to);

/// MAV_CMD_COMPONENT_ARM_DISARM, to arm: never forced.
mavlink::CommandLong arm_request(const Recipient& to);

/// The command that takes off: ArduPilot climbs to height_m above home. PX4 is put into its
/// take-off mode and climbs to its own MIS_TAKEOFF_ALT: its take-off command wants an altitude over
/// the sea and not-a-numbers for "here", and no such number leaves Kestrel.
mavlink::CommandLong takeoff_request(const AutopilotProfile& profile, double height_m,
                                     const Recipient& to);

/// MAV_CMD_SET_MESSAGE_INTERVAL: this message so many times a second; rate_hz is positive.
mavlink::CommandLong interval_request(std::uint32_t message_id, double rate_hz,
                                      const Recipient& to);

}  // namespace kestrel
