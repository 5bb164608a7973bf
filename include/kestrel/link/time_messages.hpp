#pragma once

#include <array>
#include <cstdint>

// MAVLink messages (mavlink.io, "common"): clocks. Units are in the names; fields after
// "extensions" are missing in the frames of older senders, and are then zero.
namespace kestrel::mavlink {

/// SYSTEM_TIME (2): wall clock and time since start.
struct SystemTime {
  std::uint64_t time_unix_us = 0;
  std::uint32_t time_boot_ms = 0;
};

/// PING (4): asks for an answer with the same numbers; targets 0 in the question.
struct Ping {
  std::uint64_t time_us = 0;
  std::uint32_t seq = 0;
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
};

/// TIMESYNC (111): with tc1 = 0 a question stamped ts1 by the asker; else the answer: tc1 is the
/// clock of the one who answers, ts1 is mirrored.
struct TimeSync {
  std::int64_t tc1_ns = 0;
  std::int64_t ts1_ns = 0;
  // extensions
  std::uint8_t target_system = 0;     // 0: all
  std::uint8_t target_component = 0;  // 0: all
};

}  // namespace kestrel::mavlink
