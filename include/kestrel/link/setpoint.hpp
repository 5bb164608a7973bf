#pragma once

#include <cstdint>
#include <optional>

#include "kestrel/link/message.hpp"
#include "kestrel/vehicle/velocity_command.hpp"

namespace kestrel {

/// Velocities and yaw rate are to be followed; position, acceleration and yaw to be ignored.
constexpr std::uint16_t kVelocityAndYawRate = 0x5C7;

/// MAV_FRAME_BODY_NED: forward, right, down in the heading frame, which ArduPilot and PX4 both turn
/// by the yaw only. The other body frames (9, 12) are not obeyed by both.
constexpr std::uint8_t kHeadingFrame = 8;

/// A system and a component of it, as MAVLink counts them; 0 is everybody.
struct Recipient {
  std::uint8_t system_id = 1;
  std::uint8_t component_id = 1;  // MAV_COMP_ID_AUTOPILOT1
};

/// Milliseconds of a stamp, rounded, modulo 2^32, so that differences between stamps of any origin
/// stay right; 0 for a stamp that is not finite.
std::uint32_t time_boot_ms(double stamp_s);

/// True when every number of the command is finite also as a float of the wire.
bool is_sendable(const VelocityCommand& command);

/// The setpoint that asks for the velocities; the one that asks for hover when the command is not
/// sendable. Numbers below the smallest normal float become zero: receivers may refuse them.
mavlink::SetPositionTarget velocity_setpoint(const VelocityCommand& command,
                                             std::uint32_t time_boot_ms,
                                             const Recipient& recipient);

/// True when none of the eleven floats is NaN or infinite, ignored ones included: a sender of those
/// is not to be trusted (ArduPilot has been seen to abort on one).
bool is_finite(const mavlink::SetPositionTarget& setpoint);

/// The inverse of velocity_setpoint; empty when a float is not finite, or for another frame or type
/// mask than its own.
std::optional<VelocityCommand> velocity_of(const mavlink::SetPositionTarget& setpoint);

}  // namespace kestrel
