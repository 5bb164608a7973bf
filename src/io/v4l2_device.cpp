#include "v4l2_device.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "kestrel/io/raw_picture.hpp"

namespace kestrel {
namespace {

constexpr __u32 kMostEntries = 256;  // a driver that never ends its list is none to believe

struct Known {
  __u32 fourcc;
  RawFormat format;
};

constexpr std::array<Known, 9> kKnown = {{{V4L2_PIX_FMT_GREY, RawFormat::Grey},
                                          {V4L2_PIX_FMT_NV12, RawFormat::Nv12},
                                          {V4L2_PIX_FMT_YUV420, RawFormat::Yuv420},
                                          {V4L2_PIX_FMT_YUYV, RawFormat::Yuyv},
                                          {V4L2_PIX_FMT_UYVY, RawFormat::Uyvy},
                                          {V4L2_PIX_FMT_BGR24, RawFormat::Bgr24},
                                          {V4L2_PIX_FMT_RGB24, RawFormat::Rgb24},
                                          {V4L2_PIX_FMT_MJPEG, RawFormat::Mjpeg},
                                          {V4L2_PIX_FMT_JPEG, RawFormat::Mjpeg}}};

std::string remedy(int cause) {
  if (cause == ENOENT || cause == ENXIO || cause == ENODEV)
    return "connect the camera, or name another ('kestrel cameras' lists them)";
  if (cause == EACCES || cause == EPERM) return "add yourself to the group video, and log in again";
  if (cause == EBUSY) return "end the other program that uses it";
  if (cause == ENOSPC)
    return "the USB bus has no room: choose a smaller size, a lower rate or mjpeg";
  return "unplug it and plug it in again";
}

double hertz(const v4l2_fract& interval) {
  return interval.numerator == 0 ? 0 : double(interval.denominator) / interval.numerator;
}

std::vector<double> rates_of(const V4l2Device& device, __u32 fourcc, cv::Size size) {
  std::vector<double> rates;
  v4l2_frmivalenum at{};
  at.pixel_format = fourcc;
  at.width = __u32(size.width);
  at.height = __u32(size.height);
  for (; at.index < kMostEntries && device.control(VIDIOC_ENUM_FRAMEINTERVALS, at); ++at.index) {
    if (at.type == V4L2_FRMIVAL_TYPE_DISCRETE) {
      rates.push_back(hertz(at.discrete));
      continue;
    }
    rates.push_back(hertz(at.stepwise.max));  // the longest interval is the lowest rate
    rates.push_back(hertz(at.stepwise.min));
    break;
  }
  rates.erase(std::remove(rates.begin(), rates.end(), 0.0), rates.end());
  return rates;
}

/// The sizes of a format; of a range its ends, and the wanted one when it lies on its grid.
std::vector<cv::Size> sizes_of(const V4l2Device& device, __u32 fourcc,
                               const std::optional<cv::Size>& wanted) {
  std::vector<cv::Size> sizes;
  v4l2_frmsizeenum at{};
  at.pixel_format = fourcc;
  for (; at.index < kMostEntries && device.control(VIDIOC_ENUM_FRAMESIZES, at); ++at.index) {
    if (at.type == V4L2_FRMSIZE_TYPE_DISCRETE) {
      sizes.emplace_back(int(at.discrete.width), int(at.discrete.height));
      continue;
    }
    const v4l2_frmsize_stepwise& s = at.stepwise;
    const auto fits = [](int value, __u32 low, __u32 high, __u32 step) {
      return value >= int(low) && value <= int(high) &&
             (step == 0 || (__u32(value) - low) % step == 0);
    };
    sizes.emplace_back(int(s.min_width), int(s.min_height));
    for (const cv::Size& size : {cv::Size(640, 480), wanted.value_or(cv::Size(640, 480))}) {
      const bool is_new = std::find(sizes.begin(), sizes.end(), size) == sizes.end();
      if (is_new && fits(size.width, s.min_width, s.max_width, s.step_width) &&
          fits(size.height, s.min_height, s.max_height, s.step_height))
        sizes.push_back(size);
    }
    sizes.emplace_back(int(s.max_width), int(s.max_height));
    break;
  }
  return sizes;
}

}  // namespace

V4l2Device::V4l2Device(std::string path, DeviceCalls& calls)
    : path_(std::move(path)), calls_(calls), descriptor_(calls.open(path_)) {
  if (descriptor_ < 0) fail_with_cause("it cannot be opened");
}

V4l2Device::~V4l2Device() { calls_.close(descriptor_); }

void V4l2Device::fail(const std::string& what) const {
  throw std::runtime_error(path_ + ": " + what);
}

void V4l2Device::fail_with_cause(const char* doing) const {
  const int cause = errno;
  const std::string what = cause == ENOENT ? "there is no such device"
                                           : std::string(doing) + ": " + std::strerror(cause);
  fail(what + "; " + remedy(cause));
}

v4l2_capability capability(const V4l2Device& device) {
  v4l2_capability it{};
  device.require(VIDIOC_QUERYCAP, it, "it does not answer as a camera");
  return it;
}

bool captures_video(const v4l2_capability& capability) {
  const bool has_own = (capability.capabilities & V4L2_CAP_DEVICE_CAPS) != 0;
  const __u32 can = has_own ? capability.device_caps : capability.capabilities;
  return (can & V4L2_CAP_VIDEO_CAPTURE) != 0 && (can & V4L2_CAP_STREAMING) != 0;
}

std::vector<CameraMode> modes_of(const V4l2Device& device, const std::optional<cv::Size>& wanted) {
  std::vector<CameraMode> modes;
  v4l2_fmtdesc format{};
  format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  for (; format.index < kMostEntries && device.control(VIDIOC_ENUM_FMT, format); ++format.index) {
    for (const cv::Size& size : sizes_of(device, format.pixelformat, wanted))
      modes.push_back(
          {format_name(format.pixelformat), size, rates_of(device, format.pixelformat, size)});
  }
  return modes;
}

std::string format_name(__u32 fourcc) {
  for (const Known& known : kKnown) {
    if (known.fourcc == fourcc) return name(known.format);
  }
  std::string letters;
  for (int byte = 0; byte < 4; ++byte) {
    const char letter = char((fourcc >> (8 * byte)) & 0x7F);
    if (letter > ' ')
      letters += char(letter >= 'A' && letter <= 'Z' ? letter + ('a' - 'A') : letter);
  }
  return letters;
}

__u32 fourcc_of(const std::string& format) {
  for (const Known& known : kKnown) {
    if (format == name(known.format)) return known.fourcc;
  }
  return 0;
}

}  // namespace kestrel
