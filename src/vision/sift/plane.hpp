#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace kestrel::sift {

/// -1 is 1, size is size - 2: rows beyond an image of `size` rows.
inline int mirrored(int i, int size) {
  if (size == 1) return 0;
  const int period = 2 * (size - 1);
  const int j = ((i % period) + period) % period;
  return j < size ? j : period - j;
}

/// The rows of an image, or the last few of them only, in memory that is kept.
template <typename Element>
class Plane {
 public:
  /// Room for `kept` of `height` rows of `stride` elements; row v takes the place of row v - kept.
  /// Nothing is done when it has that shape already.
  void shape(int height, int kept, int stride) {
    if (height == height_ && kept == kept_ && stride == stride_) return;
    height_ = height;
    kept_ = kept;
    stride_ = stride;
    const std::size_t size = std::size_t(kept) * std::size_t(stride) + kTail + kAlignment;
    if (storage_.size() < size) storage_.resize(size);
    rows_.resize(std::size_t(height) + 2 * std::size_t(kBeyond));
    Element* const first = aligned();
    for (int v = -kBeyond; v < height + kBeyond; ++v)
      rows_[index(v)] = first + std::ptrdiff_t(mirrored(v, height) % kept) * stride;
  }

  /// -kBeyond <= v < height + kBeyond; mirrored beyond the image.
  Element* row(int v) const { return rows_[index(v)]; }
  Element* const* rows(int v) const { return &rows_[index(v)]; }
  int stride() const { return stride_; }

  static constexpr int kBeyond = 32;

 private:
  static constexpr std::size_t kTail = 64;       // a kernel may read so far past the last row
  static constexpr std::size_t kAlignment = 64;  // bytes, and elements to spare

  static std::size_t index(int v) { return std::size_t(std::ptrdiff_t(v) + kBeyond); }

  Element* aligned() {
    void* at = storage_.data();
    std::size_t space = storage_.size() * sizeof(Element);
    return static_cast<Element*>(std::align(kAlignment, sizeof(Element), at, space));
  }

  int height_ = 0;
  int kept_ = 0;
  int stride_ = 0;
  std::vector<Element> storage_;
  std::vector<Element*> rows_;
};

}  // namespace kestrel::sift
