#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kestrel/link/bytes.hpp"
#include "kestrel/link/frame.hpp"

namespace kestrel {

/// Frames that wait until a stream takes more bytes. Its memory is fixed when it is made: when it
/// is full the oldest frame makes room, for the newest command is the one that counts. A frame of
/// which a part has gone is never dropped, else the other end would lose the boundaries.
class SendQueue {
 public:
  /// Holds up to `frames` of at most mavlink::kMaxFrame bytes. Throws std::invalid_argument for
  /// fewer than two: one may be half sent.
  explicit SendQueue(std::size_t frames);

  /// Puts a frame at the end, of which the first `sent` bytes are gone already; an older one may
  /// be dropped for it. What is larger than a frame, or empty, is dropped itself.
  void push(Bytes frame, std::size_t sent = 0) noexcept;

  /// What is to be sent next: the rest of the oldest frame, empty when nothing waits.
  Bytes next() const noexcept;

  /// Says how many bytes of next() have gone.
  void sent(std::size_t bytes) noexcept;

  /// Forgets all that waits, and counts it as dropped.
  void clear() noexcept;

  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }  // frames
  long dropped() const { return dropped_; }   // frames, since it was made

 private:
  struct Slot {
    std::array<std::uint8_t, mavlink::kMaxFrame> data;
    std::size_t size = 0;
  };
  Slot& slot(std::size_t place) { return slots_[(first_ + place) % slots_.size()]; }
  void drop_oldest() noexcept;

  std::vector<Slot> slots_;  // a ring
  std::size_t first_ = 0;
  std::size_t size_ = 0;
  std::size_t gone_ = 0;  // bytes of the first
  long dropped_ = 0;
};

}  // namespace kestrel
