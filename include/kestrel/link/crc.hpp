#pragma once

#include <cstdint>

#include "kestrel/link/bytes.hpp"

namespace kestrel {

/// CRC-16/MCRF4XX (polynomial 0x1021 reflected, no final complement) after one more byte: the
/// checksum of MAVLink.
constexpr std::uint16_t crc_add(std::uint16_t crc, std::uint8_t byte) {
  // The eight shifts of the reflected polynomial x^16 + x^12 + x^5 + 1, done at once.
  auto mixed = static_cast<std::uint8_t>(byte ^ (crc & 0xFF));
  mixed = static_cast<std::uint8_t>(mixed ^ (mixed << 4));
  return static_cast<std::uint16_t>((crc >> 8) ^ (mixed << 8) ^ (mixed << 3) ^ (mixed >> 4));
}

constexpr std::uint16_t kCrcStart = 0xFFFF;

/// The checksum after all the bytes, continued from `crc`.
constexpr std::uint16_t crc_add(std::uint16_t crc, Bytes bytes) {
  for (const std::uint8_t byte : bytes) crc = crc_add(crc, byte);
  return crc;
}

}  // namespace kestrel
