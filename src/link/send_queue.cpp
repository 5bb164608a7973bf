#include "kestrel/link/send_queue.hpp"

#include <algorithm>
#include <stdexcept>

namespace kestrel {

SendQueue::SendQueue(std::size_t frames) : slots_(frames) {
  if (frames < 2) throw std::invalid_argument("queue_frames must be at least 2");
}

void SendQueue::push(Bytes frame, std::size_t sent) noexcept {
  if (frame.size == 0 || frame.size > mavlink::kMaxFrame) {
    ++dropped_;
    return;
  }
  if (size_ == slots_.size()) drop_oldest();
  if (size_ == 0) gone_ = std::min(sent, frame.size - 1);
  Slot& last = slot(size_++);
  std::copy(frame.begin(), frame.end(), last.data.begin());
  last.size = frame.size;
}

void SendQueue::drop_oldest() noexcept {
  ++dropped_;
  if (gone_ > 0) slot(1) = slot(0);  // the half sent frame stays, the one after it goes
  first_ = (first_ + 1) % slots_.size();
  --size_;
}

Bytes SendQueue::next() const noexcept {
  if (size_ == 0) return {};
  const Slot& oldest = slots_[first_];
  return Bytes{oldest.data.data(), oldest.size}.after(gone_);
}

void SendQueue::sent(std::size_t bytes) noexcept {
  if (size_ == 0) return;
  gone_ += bytes;
  if (gone_ < slots_[first_].size) return;
  gone_ = 0;
  first_ = (first_ + 1) % slots_.size();
  --size_;
}

void SendQueue::clear() noexcept {
  dropped_ += long(size_);
  first_ = size_ = gone_ = 0;
}

}  // namespace kestrel
