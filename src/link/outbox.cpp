#include "kestrel/link/outbox.hpp"

#include <algorithm>

namespace kestrel {

void Outbox::start(double unix_s) {
  unix_s_ = unix_s;
  deliveries_.clear();
}

void Outbox::forward(const mavlink::FrameView& frame, const Addressee& to) {
  deliver(to.key != nullptr ? mavlink::signed_frame(frame, stamp(to.link_id), *to.key)
                            : mavlink::unsigned_frame(frame),
          to.peer);
}

void Outbox::post(const mavlink::Message& message, const mavlink::Envelope& envelope,
                  const Addressee& to) {
  deliver(to.key != nullptr ? mavlink::signed_frame(message, envelope, stamp(to.link_id), *to.key)
                            : mavlink::encode(message, envelope),
          to.peer);
}

void Outbox::deliver(const mavlink::EncodedFrame& frame, PeerId to) {
  const std::size_t place = deliveries_.size();
  if (place == frames_.size()) frames_.emplace_back();
  frames_[place] = frame;
  deliveries_.push_back({to, frames_[place].bytes()});
}

/// A zero must go out also when no time can be reserved on a full disk: then the clock counts on.
mavlink::SigningStamp Outbox::stamp(std::uint8_t link_id) {
  const auto reserved = times_ ? times_(unix_s_) : std::nullopt;
  const std::uint64_t wanted = reserved.value_or(mavlink::signing_time(unix_s_));
  last_time_ = std::min(std::max(wanted, last_time_ + 1), mavlink::kLastSigningTime);
  return {link_id, last_time_};
}

}  // namespace kestrel
