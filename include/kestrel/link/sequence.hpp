#pragma once

#include <cstdint>

namespace kestrel {

/// How a frame stands to those before it of the same sender.
enum class Arrival {
  New,        // newer than all before
  Late,       // overtaken by a newer one
  Duplicate,  // was here before
};

/// Sequence numbers of one sender, modulo 256: a number up to 63 behind the newest is an old frame,
/// any other a new one after a gap.
class SequenceWindow {
 public:
  Arrival arrive(std::uint8_t sequence);

  /// Frames of the gaps that have not come late so far.
  long lost() const { return lost_; }

 private:
  bool started_ = false;
  std::uint8_t newest_ = 0;
  std::uint64_t seen_ = 0;     // bit i: the number i behind the newest was here
  std::uint64_t missing_ = 0;  // bit i: it was skipped by a gap and has not come since
  long lost_ = 0;
};

}  // namespace kestrel
