#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>

#include "kestrel/io/camera_device.hpp"

namespace kestrel {

/// The newest pictures of a camera between the thread that reads them and the one that takes them.
/// It holds at most `capacity`: to put one into a full queue lets the oldest go, so who puts never
/// waits. Pictures that went are counted in Picture::lost of the one after them: the sum of
/// 1 + lost over what was taken is the number of pictures up to the last one taken.
class PictureQueue {
 public:
  /// capacity: 1 keeps the latest picture only. Throws std::invalid_argument for 0.
  explicit PictureQueue(std::size_t capacity);

  void put(Picture picture);

  /// The oldest picture kept; waits up to wait_s for one. Empty when none came.
  std::optional<Picture> take(double wait_s);

  /// How many were let go because the queue was full.
  std::int64_t dropped() const;

 private:
  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable filled_;
  std::deque<Picture> pictures_;
  std::int64_t dropped_ = 0;
};

}  // namespace kestrel
