#pragma once

#include <cstdint>
#include <cstring>
#include <variant>
#include <vector>

#include "kestrel/link/message.hpp"

#include "support/random.hpp"

namespace kestrel::test {

using Buffer = std::vector<std::uint8_t>;

inline Bytes view(const Buffer& buffer) { return {buffer.data(), buffer.size()}; }
inline Buffer copy(Bytes bytes) { return Buffer(bytes.begin(), bytes.end()); }
inline Buffer joined(const std::vector<Buffer>& parts) {
  Buffer all;
  for (const Buffer& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

inline std::uint8_t random_byte(Random& random) { return std::uint8_t(random.integer(0, 255)); }
inline std::uint32_t random_bits(Random& random) {
  return std::uint32_t(random.integer(0, 0xFFFF)) << 16 | std::uint32_t(random.integer(0, 0xFFFF));
}
inline std::uint32_t bits_of(float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}
inline float float_of(std::uint32_t bits) {
  float value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// Any finite float: of every size, with both zeros, the extremes and denormals often among them.
inline float random_float(Random& random) {
  static const std::uint32_t kEdges[] = {0x00000000, 0x80000000, 0x00000001, 0x807FFFFF,
                                         0x00800000, 0x7F7FFFFF, 0xFF7FFFFF, 0x3F800000};
  if (random.integer(0, 3) == 0) return float_of(kEdges[random.integer(0, 7)]);
  const std::uint32_t bits = random_bits(random);
  return float_of((bits & 0x7F800000) == 0x7F800000 ? bits & 0xBFFFFFFF : bits);
}

inline mavlink::Heartbeat random_heartbeat(Random& random) {
  return {random_bits(random), random_byte(random), random_byte(random),
          random_byte(random), random_byte(random), random_byte(random)};
}

inline mavlink::SetPositionTarget random_setpoint(Random& random) {
  mavlink::SetPositionTarget s;
  s.time_boot_ms = random_bits(random);
  for (float* value : {&s.x_m, &s.y_m, &s.z_m, &s.vx_m_s, &s.vy_m_s, &s.vz_m_s, &s.ax_m_s2,
                       &s.ay_m_s2, &s.az_m_s2, &s.yaw_rad, &s.yaw_rate_rad_s}) {
    *value = random_float(random);
  }
  s.type_mask = std::uint16_t(random_bits(random));
  s.target_system = random_byte(random);
  s.target_component = random_byte(random);
  // Half of them end in zeros, which are trimmed.
  s.coordinate_frame = random.integer(0, 1) == 0 ? std::uint8_t{0} : random_byte(random);
  return s;
}

inline mavlink::Message random_message(Random& random) {
  if (random.integer(0, 1) == 0) return random_heartbeat(random);
  return random_setpoint(random);
}

inline mavlink::Envelope random_envelope(Random& random) {
  return {random_byte(random), random_byte(random), random_byte(random)};
}

inline Buffer random_frame(Random& random) {
  return copy(mavlink::encode(random_message(random), random_envelope(random)).bytes());
}

/// Every field as a number, floats as their bits, in the order of the wire.
inline std::vector<std::uint32_t> fields(const mavlink::Message& message) {
  if (const auto* h = std::get_if<mavlink::Heartbeat>(&message)) {
    return {h->custom_mode, h->type,          h->autopilot,
            h->base_mode,   h->system_status, h->mavlink_version};
  }
  const auto& s = std::get<mavlink::SetPositionTarget>(message);
  return {s.time_boot_ms,     bits_of(s.x_m),     bits_of(s.y_m),     bits_of(s.z_m),
          bits_of(s.vx_m_s),  bits_of(s.vy_m_s),  bits_of(s.vz_m_s),  bits_of(s.ax_m_s2),
          bits_of(s.ay_m_s2), bits_of(s.az_m_s2), bits_of(s.yaw_rad), bits_of(s.yaw_rate_rad_s),
          s.type_mask,        s.target_system,    s.target_component, s.coordinate_frame};
}

/// A frame put together by hand, with a checksum of its own: one shift a bit.
inline Buffer hand_made_frame(std::uint32_t id, const Buffer& payload, std::uint8_t crc_extra,
                              std::uint8_t incompat = 0, std::uint8_t sequence = 0) {
  const Buffer header = {0xFD,
                         std::uint8_t(payload.size()),
                         incompat,
                         0,
                         sequence,
                         1,
                         191,
                         std::uint8_t(id),
                         std::uint8_t(id >> 8),
                         std::uint8_t(id >> 16)};
  Buffer frame = joined({header, payload});
  Buffer checked(frame.begin() + 1, frame.end());
  checked.push_back(crc_extra);
  unsigned crc = 0xFFFF;
  for (const std::uint8_t byte : checked) {
    crc ^= byte;
    for (int i = 0; i < 8; ++i) crc = (crc & 1) != 0 ? crc >> 1 ^ 0x8408 : crc >> 1;
  }
  frame.push_back(std::uint8_t(crc));
  frame.push_back(std::uint8_t(crc >> 8));
  return frame;
}

/// What a datagram holds, in its order.
struct Contents {
  std::vector<mavlink::Packet> packets;
  std::vector<mavlink::Refusal> refusals;
  std::size_t size = 0;
};

inline Contents contents(const Buffer& datagram) {
  Contents all;
  for (Bytes rest = view(datagram); rest.size > 0;) {
    const mavlink::Decoded decoded = mavlink::decode(rest);
    if (const auto* packet = std::get_if<mavlink::Packet>(&decoded.content)) {
      all.packets.push_back(*packet);
    } else {
      all.refusals.push_back(std::get<mavlink::Refusal>(decoded.content));
    }
    if (decoded.size == 0 || decoded.size > rest.size) return {};  // never ends, or leaves
    all.size += decoded.size;
    rest = rest.after(decoded.size);
  }
  return all;
}

}  // namespace kestrel::test
