#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>

#include "kestrel/link/bytes.hpp"

namespace kestrel {

/// What stands before the pixels of one frame on a stream of frames. On the wire, little-endian:
///
///   byte  0  "KSTF"                    byte 16  number, 64-bit
///         4  version, 16-bit: 1             24  capture_s, 64-bit float
///         6  size of the header: 40         32  sent_s, 64-bit float
///         8  width_px, 32-bit               40  width_px * height_px bytes of grey, row by row
///        12  height_px, 32-bit
struct FrameHeader {
  std::uint32_t width_px = 0;
  std::uint32_t height_px = 0;
  std::uint64_t number = 0;  // counts the camera's frames, those that were never sent too
  double capture_s = 0;      // on the clock of the sender, which starts where it likes
  double sent_s = 0;         // on the same clock, when the header left

  /// Bytes that follow the header.
  std::size_t pixels() const { return std::size_t(width_px) * height_px; }
};

constexpr std::size_t kFrameHeaderBytes = 40;

/// No side is longer: what a header may make its reader allocate is bounded, 67 MB.
constexpr std::uint32_t kMaxFrameSide_px = 8192;

/// The header as bytes.
std::array<std::uint8_t, kFrameHeaderBytes> encode(const FrameHeader& header);

/// The header that these bytes begin with, or what is wrong with them, for a human: too few bytes,
/// no such header, another version, an impossible size or time.
std::variant<FrameHeader, std::string> decode_frame_header(Bytes bytes);

}  // namespace kestrel
