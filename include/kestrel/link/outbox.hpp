#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "kestrel/link/bytes.hpp"
#include "kestrel/link/frame.hpp"
#include "kestrel/link/peer_counters.hpp"
#include "kestrel/link/signing.hpp"

namespace kestrel {

/// Bytes to be sent to a peer: one frame. They live until the next call.
struct Delivery {
  PeerId to = 0;
  Bytes bytes;
};

/// A signing time later than all before for a frame signed at unix_s; empty when there is none to
/// give (TimestampStore::next).
using SigningTimes = std::function<std::optional<std::uint64_t>(double unix_s)>;

/// Who is to have a frame, and the key of the link: with one it is signed, without one it is sent
/// without any signature it had.
struct Addressee {
  PeerId peer = 0;
  std::uint8_t link_id = 0;
  const mavlink::SigningKey* key = nullptr;
};

/// The frames of one call, in their order. Their room is used again: a call of a kind that was seen
/// before allocates nothing.
class Outbox {
 public:
  /// Without `times` they count from the clock in memory.
  explicit Outbox(SigningTimes times) : times_(std::move(times)) {}

  /// Forgets the deliveries of the last call.
  void start(double unix_s);

  /// Somebody's frame.
  void forward(const mavlink::FrameView& frame, const Addressee& to);

  /// A message of the switch's own making.
  void post(const mavlink::Message& message, const mavlink::Envelope& envelope,
            const Addressee& to);

  const std::vector<Delivery>& deliveries() const { return deliveries_; }

 private:
  void deliver(const mavlink::EncodedFrame& frame, PeerId to);
  mavlink::SigningStamp stamp(std::uint8_t link_id);

  SigningTimes times_;
  double unix_s_ = 0;
  std::uint64_t last_time_ = 0;
  std::deque<mavlink::EncodedFrame> frames_;  // a deque: they do not move when it grows
  std::vector<Delivery> deliveries_;
};

}  // namespace kestrel
