#include "kestrel/link/autopilot_profile.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace kestrel {
namespace {

struct Mode {
  std::uint32_t custom_mode;
  const char* name;
};

constexpr Mode kArduPilotModes[] = {{0, "STABILIZE"}, {1, "ACRO"},   {2, "ALT_HOLD"},
                                    {3, "AUTO"},      {4, "GUIDED"}, {5, "LOITER"},
                                    {6, "RTL"},       {7, "CIRCLE"}, {9, "LAND"},
                                    {16, "POSHOLD"},  {17, "BRAKE"}, {21, "SMART_RTL"}};
constexpr Mode kPx4Modes[] = {{px4_mode(1), "MANUAL"},         {px4_mode(2), "ALTCTL"},
                              {px4_mode(3), "POSCTL"},         {px4_mode(4, 2), "AUTO.TAKEOFF"},
                              {px4_mode(4, 3), "AUTO.LOITER"}, {px4_mode(4, 4), "AUTO.MISSION"},
                              {px4_mode(4, 5), "AUTO.RTL"},    {px4_mode(4, 6), "AUTO.LAND"},
                              {px4_mode(5), "ACRO"},           {px4_mode(6), "OFFBOARD"},
                              {px4_mode(7), "STABILIZED"}};

mavlink::CommandLong command_to(const Recipient& to, std::uint16_t command) {
  mavlink::CommandLong message;
  message.command = command;
  message.target_system = to.system_id;
  message.target_component = to.component_id;
  return message;
}

}  // namespace

const char* name(Autopilot autopilot) {
  return autopilot == Autopilot::ArduPilot ? "ardupilot" : "px4";
}

std::string command_name(std::uint16_t command) {
  switch (command) {
    case kCommandLand:
      return "land";
    case kCommandTakeOff:
      return "take-off";
    case kCommandMode:
      return "mode";
    case kCommandArm:
      return "arm";
    case kCommandInterval:
      return "message interval";
    default:
      return "command " + std::to_string(command);
  }
}

AutopilotProfile profile_of(Autopilot autopilot) {
  if (autopilot == Autopilot::ArduPilot) return {};
  return {Autopilot::Px4, kPx4Offboard, kPx4Land, kPx4Hold, 1.0, 1.0, false};
}

std::optional<Autopilot> autopilot_of(const mavlink::Heartbeat& heartbeat) {
  constexpr std::uint8_t kRotorcraft[] = {2, 3, 4, 13, 14, 15, 29, 35};
  if (std::find(std::begin(kRotorcraft), std::end(kRotorcraft), heartbeat.type) ==
      std::end(kRotorcraft)) {
    return std::nullopt;
  }
  if (heartbeat.autopilot == 3) return Autopilot::ArduPilot;
  if (heartbeat.autopilot == 12) return Autopilot::Px4;
  return std::nullopt;
}

std::string mode_name(Autopilot autopilot, std::uint32_t custom_mode) {
  const auto search = [&](const auto& modes) -> std::string {
    for (const Mode& mode : modes) {
      if (mode.custom_mode == custom_mode) return mode.name;
    }
    return "mode " + std::to_string(custom_mode);
  };
  return autopilot == Autopilot::ArduPilot ? search(kArduPilotModes) : search(kPx4Modes);
}

bool is_armed(const mavlink::Heartbeat& heartbeat) { return (heartbeat.base_mode & 0x80) != 0; }

mavlink::CommandLong mode_request(const AutopilotProfile& profile, std::uint32_t custom_mode,
                                  const Recipient& to) {
  mavlink::CommandLong message = command_to(to, kCommandMode);
  message.param1 = 1;  // MAV_MODE_FLAG_CUSTOM_MODE_ENABLED
  if (profile.autopilot == Autopilot::ArduPilot) {
    message.param2 = float(custom_mode);
  } else {
    message.param2 = float(custom_mode >> 16 & 0xFF);
    message.param3 = float(custom_mode >> 24 & 0xFF);
  }
  return message;
}

mavlink::CommandLong arm_request(const Recipient& to) {
  mavlink::CommandLong message = command_to(to, kCommandArm);
  message.param1 = 1;
  return message;
}

mavlink::CommandLong takeoff_request(const AutopilotProfile& profile, double height_m,
                                     const Recipient& to) {
  if (profile.autopilot == Autopilot::Px4) return mode_request(profile, kPx4TakeOff, to);
  mavlink::CommandLong message = command_to(to, kCommandTakeOff);
  message.param7 = float(height_m);
  return message;
}

mavlink::CommandLong interval_request(std::uint32_t message_id, double rate_hz,
                                      const Recipient& to) {
  mavlink::CommandLong message = command_to(to, kCommandInterval);
  message.param1 = float(message_id);
  message.param2 = float(std::round(1e6 / rate_hz));
  return message;
}

}  // namespace kestrel
