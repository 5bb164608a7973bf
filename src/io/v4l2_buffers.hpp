#pragma once

#include <vector>

#include "v4l2_device.hpp"

namespace kestrel {

/// Memory of the driver for the pictures, shared with it and given back at the end.
class V4l2Buffers {
 public:
  struct Part {
    void* start;
    std::size_t bytes;
  };

  /// Asks for it and hands all of it to the driver to fill. Throws std::runtime_error when that
  /// fails. The device must outlive it.
  explicit V4l2Buffers(const V4l2Device& device);
  ~V4l2Buffers();
  V4l2Buffers(const V4l2Buffers&) = delete;
  V4l2Buffers& operator=(const V4l2Buffers&) = delete;

  const Part& operator[](std::size_t index) const { return parts_.at(index); }
  std::size_t count() const { return parts_.size(); }

  /// What the driver is told of a part.
  static v4l2_buffer buffer(__u32 index);

 private:
  void share(__u32 count);
  void give_back() noexcept;

  const V4l2Device& device_;
  std::vector<Part> parts_;
};

}  // namespace kestrel
