#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "fuzz/watched_switch.hpp"

namespace kestrel::fuzz {

/// The bytes of a fuzzer as a stream of choices; zeros when they have run out.
class Choices {
 public:
  explicit Choices(Bytes bytes) : bytes_(bytes) {}
  bool are_left() const { return bytes_.size > 0; }
  std::uint8_t byte();
  /// 0 to count - 1.
  unsigned pick(unsigned count) { return byte() % count; }
  std::uint32_t word();
  Bytes take(std::size_t count);

 private:
  Bytes bytes_;
};

/// Bytes as they are to peers of every link.
void tell_raw_story(Bytes bytes);

/// Frames with right checksums and signatures, told by the bytes: who sends which message, when,
/// how late, with which sequence numbers; peers that come and go; clocks that step; control
/// messages. Setpoints that must not be obeyed ask for a climb, no other does: if the vehicle is
/// ever told to climb, one of them got through.
void tell_built_story(Bytes bytes);

}  // namespace kestrel::fuzz
