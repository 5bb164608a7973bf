#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <variant>

#include "kestrel/link/bytes.hpp"

// MAVLink 2 messages and their frames on the wire (mavlink.io, "Packet Serialization").
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

/// SET_POSITION_TARGET_LOCAL_NED (84): a setpoint for the flight controller, in the frame that
/// coordinate_frame names; a bit set in type_mask says that a field is to be ignored.
struct SetPositionTarget {
  std::uint32_t time_boot_ms = 0;
  float x_m = 0, y_m = 0, z_m = 0;
  float vx_m_s = 0, vy_m_s = 0, vz_m_s = 0;
  float ax_m_s2 = 0, ay_m_s2 = 0, az_m_s2 = 0;
  float yaw_rad = 0;
  float yaw_rate_rad_s = 0;
  std::uint16_t type_mask = 0;
  std::uint8_t target_system = 0;     // 0: all
  std::uint8_t target_component = 0;  // 0: all
  std::uint8_t coordinate_frame = 0;  // MAV_FRAME
};

using Message = std::variant<Heartbeat, SetPositionTarget>;

/// Who sends, and the how-manieth frame of theirs this is, modulo 256.
struct Envelope {
  std::uint8_t system_id = 0;
  std::uint8_t component_id = 0;
  std::uint8_t sequence = 0;
};

/// An intact frame.
struct Packet {
  Envelope envelope;
  Message message;
};

/// Why bytes are not a frame to be obeyed.
enum class Refusal {
  BadMagic,             // they do not start with the mark of MAVLink 2
  Truncated,            // they end before the frame they announce
  BadCrc,               // damaged, or another dialect's idea of the message
  UnknownMessage,       // not in the tables, hence not verifiable
  UnknownIncompatFlag,  // intact, but asks for what is not supported (0x01: signed)
};
constexpr std::size_t kRefusals = 5;

/// "bad magic", "truncated", "bad crc", "unknown message", "unknown incompat flag".
const char* name(Refusal refusal);

/// What stands at the start of some bytes, and how many of them it takes.
struct Decoded {
  std::variant<Packet, Refusal> content;
  std::size_t size = 0;
};

constexpr std::uint8_t kMagic = 0xFD;
constexpr std::size_t kHeaderSize = 10;
constexpr std::size_t kCrcSize = 2;
constexpr std::size_t kSignatureSize = 13;
constexpr std::size_t kMaxPayload = 255;
constexpr std::size_t kMaxFrame = kHeaderSize + kMaxPayload + kCrcSize + kSignatureSize;

/// A frame ready to be sent.
struct EncodedFrame {
  std::array<std::uint8_t, kMaxFrame> data{};
  std::size_t size = 0;

  Bytes bytes() const { return {data.data(), size}; }
};

/// The frame of a message, every bit kept, trailing zeros of the payload trimmed (but for its
/// first byte, which is always sent).
EncodedFrame encode(const Message& message, const Envelope& envelope);

/// What stands at the start of a datagram: a packet, or why not and how many bytes to pass over.
/// Read a datagram by
///     for (Bytes rest = datagram; rest.size > 0; rest = rest.after(decode(rest).size))
/// which always ends. After damage the next intact frame is found wherever it starts. A frame of
/// an unknown message that ends where the datagram does, or where another frame seems to start, is
/// passed over whole: what it carries (a log, another vehicle's traffic) is not for us to obey.
/// Empty bytes are Truncated, with size 0.
Decoded decode(Bytes bytes);

}  // namespace kestrel::mavlink
