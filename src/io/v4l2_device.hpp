#pragma once

#include <string>
#include <vector>

#include <linux/videodev2.h>

#include "kestrel/io/v4l2_camera.hpp"

namespace kestrel {

/// An open V4L2 device; closes itself.
class V4l2Device {
 public:
  /// Throws std::runtime_error when it does not open.
  V4l2Device(std::string path, DeviceCalls& calls);
  ~V4l2Device();
  V4l2Device(const V4l2Device&) = delete;
  V4l2Device& operator=(const V4l2Device&) = delete;

  /// True when the driver does it; the cause in errno when not.
  template <class Argument>
  bool control(unsigned long request, Argument& argument) const {
    return calls_.control(descriptor_, request, &argument) == 0;
  }

  /// Throws std::runtime_error when the driver does not do it.
  template <class Argument>
  void require(unsigned long request, Argument& argument, const char* doing) const {
    if (!control(request, argument)) fail_with_cause(doing);
  }

  [[noreturn]] void fail(const std::string& what) const;
  /// `doing`, the cause in errno and what to do about it.
  [[noreturn]] void fail_with_cause(const char* doing) const;

  int descriptor() const { return descriptor_; }
  DeviceCalls& calls() const { return calls_; }

 private:
  std::string path_;
  DeviceCalls& calls_;
  int descriptor_;
};

/// What the driver is and can, of this device node. Throws as require.
v4l2_capability capability(const V4l2Device& device);

/// True when this node gives video pictures through shared memory.
bool captures_video(const v4l2_capability& capability);

/// The modes that the driver names. wanted: a size that is listed too where any size is possible.
std::vector<CameraMode> modes_of(const V4l2Device& device, const std::optional<cv::Size>& wanted);

/// The name of a pixel format: a RawFormat's, or its four characters in small letters.
std::string format_name(__u32 fourcc);

/// The pixel format of a name; 0 for none.
__u32 fourcc_of(const std::string& format);

}  // namespace kestrel
