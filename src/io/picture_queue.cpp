#include "kestrel/io/picture_queue.hpp"

#include <chrono>
#include <stdexcept>

namespace kestrel {

PictureQueue::PictureQueue(std::size_t capacity) : capacity_(capacity) {
  if (capacity == 0) throw std::invalid_argument("a queue of pictures: capacity must be positive");
}

void PictureQueue::put(Picture picture) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (pictures_.size() == capacity_) {
      const std::int64_t gone = pictures_.front().lost + 1;
      pictures_.pop_front();
      (pictures_.empty() ? picture : pictures_.front()).lost += gone;
      ++dropped_;
    }
    pictures_.push_back(std::move(picture));
  }
  filled_.notify_one();
}

std::optional<Picture> PictureQueue::take(double wait_s) {
  std::unique_lock<std::mutex> lock(mutex_);
  const bool filled = filled_.wait_for(lock, std::chrono::duration<double>(wait_s),
                                       [this] { return !pictures_.empty(); });
  if (!filled) return std::nullopt;
  Picture picture = std::move(pictures_.front());
  pictures_.pop_front();
  return picture;
}

std::int64_t PictureQueue::dropped() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return dropped_;
}

}  // namespace kestrel
