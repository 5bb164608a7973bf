#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

namespace kestrel::sift {

/// Bounds the number of keypoints.
class Strongest {
 public:
  /// Leaves the `most` items of highest contrast (a float >= 0), of equal ones the first, in their
  /// order.
  template <typename Item>
  void keep(std::vector<Item>& items, int most) {
    if (items.size() <= std::size_t(most)) return;
    keys_.clear();
    for (const Item& item : items) keys_.push_back(key(item.contrast, keys_.size()));
    sorted_ = keys_;
    std::nth_element(sorted_.begin(), sorted_.begin() + most, sorted_.end());
    const std::uint64_t first_dropped = sorted_[std::size_t(most)];
    std::size_t kept = 0;
    for (std::size_t i = 0; i < items.size(); ++i)
      if (keys_[i] < first_dropped) items[kept++] = items[i];
    items.resize(kept);
  }

 private:
  /// Smaller for the stronger: the bits of a float that is not negative are in its order.
  static std::uint64_t key(float contrast, std::size_t index) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &contrast, sizeof bits);
    return std::uint64_t(~bits) << 32 | index;
  }

  std::vector<std::uint64_t> keys_;
  std::vector<std::uint64_t> sorted_;
};

}  // namespace kestrel::sift
