#pragma once

#include <cstddef>
#include <cstdint>

namespace kestrel {

/// A view of bytes that somebody else owns.
struct Bytes {
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;

  /// All but the first `count` bytes; empty when there are no more than that.
  constexpr Bytes after(std::size_t count) const {
    return {data + first(count).size, size - first(count).size};
  }

  /// The first `count` bytes, or all when there are fewer.
  constexpr Bytes first(std::size_t count) const { return {data, count < size ? count : size}; }

  constexpr const std::uint8_t* begin() const { return data; }
  constexpr const std::uint8_t* end() const { return data + size; }
};

}  // namespace kestrel
