#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>

#include "kestrel/link/bytes.hpp"
#include "kestrel/link/command_messages.hpp"
#include "kestrel/link/measurement_messages.hpp"
#include "kestrel/link/message_info.hpp"
#include "kestrel/link/motion_messages.hpp"
#include "kestrel/link/time_messages.hpp"
#include "kestrel/link/vehicle_messages.hpp"

namespace kestrel::mavlink {

/// Any message that Kestrel knows, by rising id.
using Message =
    std::variant<Heartbeat, SysStatus, SystemTime, Ping, SetMode, ParamValue, ParamSet,
                 AttitudeReport, AttitudeQuaternion, LocalPosition, GlobalPosition, ServoOutputRaw,
                 RequestDataStream, ManualControl, CommandInt, CommandLong, CommandAck,
                 SetAttitudeTarget, AttitudeTarget, SetPositionTarget, PositionTarget,
                 VisionPosition, VisionSpeed, TimeSync, AutopilotVersion, LandingTarget,
                 MessageInterval, ExtendedSysState, StatusText, SetupSigning, Odometry>;

/// The payload of a message as it goes over the wire: little-endian, every bit kept, trailing zeros
/// trimmed (but for the first byte, which is always sent).
struct Payload {
  std::array<std::uint8_t, kMaxPayload> data{};
  std::size_t size = 0;

  Bytes bytes() const { return {data.data(), size}; }
};

/// What is published of the message.
const MessageInfo& info_of(const Message& message);

Payload payload_of(const Message& message);

/// The inverse of payload_of: missing bytes are zeros, and what a newer definition appends is not
/// looked at. Empty for a message that is not known.
std::optional<Message> message_of(std::uint32_t id, Bytes payload);

}  // namespace kestrel::mavlink
