#include "v4l2_buffers.hpp"

namespace kestrel {
namespace {

constexpr __u32 kBuffers = 4;  // one being filled, one being read, two to spare

}  // namespace

v4l2_buffer V4l2Buffers::buffer(__u32 index) {
  v4l2_buffer buffer{};
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffer.memory = V4L2_MEMORY_MMAP;
  buffer.index = index;
  return buffer;
}

V4l2Buffers::V4l2Buffers(const V4l2Device& device) : device_(device) {
  v4l2_requestbuffers request{};
  request.count = kBuffers;
  request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  request.memory = V4L2_MEMORY_MMAP;
  device.require(VIDIOC_REQBUFS, request, "it gives no memory");
  if (request.count < 2) device.fail("it gives memory for one picture only; use another camera");
  try {
    share(request.count);
  } catch (...) {
    give_back();
    throw;
  }
}

V4l2Buffers::~V4l2Buffers() { give_back(); }

void V4l2Buffers::share(__u32 count) {
  for (__u32 i = 0; i < count; ++i) {
    v4l2_buffer part = buffer(i);
    device_.require(VIDIOC_QUERYBUF, part, "it does not say where its memory is");
    void* const start = device_.calls().map(device_.descriptor(), part.length, part.m.offset);
    if (start == nullptr) device_.fail_with_cause("its memory cannot be shared");
    parts_.push_back({start, part.length});
    device_.require(VIDIOC_QBUF, part, "it does not take its memory back");
  }
}

void V4l2Buffers::give_back() noexcept {
  for (const Part& part : parts_) device_.calls().unmap(part.start, part.bytes);
}

}  // namespace kestrel
