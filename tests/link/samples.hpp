#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <variant>
#include <vector>

#include "kestrel/link/frame.hpp"

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

/// A payload of the message: floats finite, else any bytes; half of them end in zeros.
inline Buffer random_payload(const mavlink::MessageInfo& info, Random& random) {
  Buffer payload(info.longest);
  for (const mavlink::FieldInfo& field : info) {
    for (std::size_t i = 0; i < field.size(); ++i) payload[field.offset + i] = random_byte(random);
    for (std::size_t i = 0; field.type == mavlink::FieldType::Float && i < field.size(); i += 4) {
      const std::uint32_t bits = bits_of(random_float(random));
      for (std::size_t k = 0; k < 4; ++k) {
        payload[field.offset + i + k] = std::uint8_t(bits >> (8 * k));
      }
    }
  }
  if (random.integer(0, 1) == 0) {
    const auto kept = std::size_t(random.integer(0, int(payload.size())));
    std::fill(payload.begin() + std::ptrdiff_t(kept), payload.end(), std::uint8_t{0});
  }
  return payload;
}

inline mavlink::Message random_message(const mavlink::MessageInfo& info, Random& random) {
  return *mavlink::message_of(info.id, view(random_payload(info, random)));
}

template <class M>
M random_message_of(Random& random) {
  return std::get<M>(random_message(mavlink::info_of(M{}), random));
}

inline mavlink::SetPositionTarget random_setpoint(Random& random) {
  return random_message_of<mavlink::SetPositionTarget>(random);
}

/// Any message that Kestrel knows.
inline mavlink::Message random_message(Random& random) {
  const mavlink::MessageInfos all = mavlink::message_infos();
  return random_message(all.begin()[random.integer(0, int(all.count) - 1)], random);
}

inline mavlink::Envelope random_envelope(Random& random) {
  return {random_byte(random), random_byte(random), random_byte(random)};
}

inline Buffer random_frame(Random& random) {
  return copy(mavlink::encode(random_message(random), random_envelope(random)).bytes());
}

/// Every field's bytes, in the order of the wire, zeros not trimmed.
inline Buffer fields(const mavlink::Message& message) {
  Buffer payload = copy(mavlink::payload_of(message).bytes());
  payload.resize(mavlink::info_of(message).longest);
  return payload;
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
