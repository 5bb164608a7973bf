#include "kestrel/link/frame_header.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace kestrel {
namespace {

constexpr std::array<std::uint8_t, 4> kMagic = {'K', 'S', 'T', 'F'};
constexpr std::uint16_t kVersion = 1;

template <class Integer>
void put(std::uint8_t* at, Integer value) {
  for (std::size_t i = 0; i < sizeof value; ++i) at[i] = std::uint8_t(value >> (8 * i));
}

void put_double(std::uint8_t* at, double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  put(at, bits);
}

template <class Integer>
Integer get(const std::uint8_t* at) {
  Integer value = 0;
  for (std::size_t i = 0; i < sizeof value; ++i) value = Integer(value | Integer(at[i]) << (8 * i));
  return value;
}

double get_double(const std::uint8_t* at) {
  const auto bits = get<std::uint64_t>(at);
  double value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

bool is_side(std::uint32_t side_px) { return side_px > 0 && side_px <= kMaxFrameSide_px; }

}  // namespace

std::array<std::uint8_t, kFrameHeaderBytes> encode(const FrameHeader& header) {
  std::array<std::uint8_t, kFrameHeaderBytes> bytes{};
  std::copy(kMagic.begin(), kMagic.end(), bytes.begin());
  put(&bytes[4], kVersion);
  put(&bytes[6], std::uint16_t{kFrameHeaderBytes});
  put(&bytes[8], header.width_px);
  put(&bytes[12], header.height_px);
  put(&bytes[16], header.number);
  put_double(&bytes[24], header.capture_s);
  put_double(&bytes[32], header.sent_s);
  return bytes;
}

std::variant<FrameHeader, std::string> decode_frame_header(Bytes bytes) {
  if (bytes.size < kFrameHeaderBytes) {
    return "a header of " + std::to_string(bytes.size) + " bytes, not " +
           std::to_string(kFrameHeaderBytes);
  }
  const std::uint8_t* const at = bytes.data;
  if (!std::equal(kMagic.begin(), kMagic.end(), at)) {
    return "no frame begins here (no KSTF): the other end sends something else";
  }
  const auto version = get<std::uint16_t>(at + 4);
  const auto size = get<std::uint16_t>(at + 6);
  if (version != kVersion || size != kFrameHeaderBytes) {
    return "frames of version " + std::to_string(version) + " with headers of " +
           std::to_string(size) + " bytes, known is version " + std::to_string(kVersion);
  }
  FrameHeader header;
  header.width_px = get<std::uint32_t>(at + 8);
  header.height_px = get<std::uint32_t>(at + 12);
  header.number = get<std::uint64_t>(at + 16);
  header.capture_s = get_double(at + 24);
  header.sent_s = get_double(at + 32);
  if (!is_side(header.width_px) || !is_side(header.height_px)) {
    return "a frame of " + std::to_string(header.width_px) + "x" +
           std::to_string(header.height_px) + " px, a side is 1 to " +
           std::to_string(kMaxFrameSide_px);
  }
  if (!std::isfinite(header.capture_s) || !std::isfinite(header.sent_s) ||
      header.sent_s < header.capture_s) {
    return std::string("a frame that was sent before it was captured, or at no time");
  }
  return header;
}

}  // namespace kestrel
