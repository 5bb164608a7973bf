// A stand-in for a V4L2 driver: it proves how Kestrel keeps to the protocol, not the kernel.
#include "io/v4l2_standin.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace kestrel::test {

int V4l2StandIn::capabilities(v4l2_capability& it, V4l2Fault fault) {
  std::memcpy(it.card, "Stand-in camera", 16);
  std::memcpy(it.driver, "standin", 8);
  std::memcpy(it.bus_info, "usb-1.2", 8);
  it.capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING | V4L2_CAP_DEVICE_CAPS;
  it.device_caps = fault == V4l2Fault::NoCapture
                       ? __u32(V4L2_CAP_META_CAPTURE)
                       : __u32(V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING);
  return 0;
}

int V4l2StandIn::format_at(v4l2_fmtdesc& it) {
  constexpr __u32 kFormats[] = {V4L2_PIX_FMT_H264, V4L2_PIX_FMT_YUYV, V4L2_PIX_FMT_GREY};
  if (it.index >= 3) return fails(EINVAL);
  it.pixelformat = kFormats[it.index];
  return 0;
}

int V4l2StandIn::size_at(v4l2_frmsizeenum& it) {
  if (it.pixel_format == V4L2_PIX_FMT_GREY) {  // any size
    if (it.index > 0) return fails(EINVAL);
    it.type = V4L2_FRMSIZE_TYPE_STEPWISE;
    it.stepwise = {16, 1280, 16, 16, 960, 8};
    return 0;
  }
  if (it.index >= 2) return fails(EINVAL);
  it.type = V4L2_FRMSIZE_TYPE_DISCRETE;
  it.discrete = it.index == 0 ? v4l2_frmsize_discrete{320, 240} : v4l2_frmsize_discrete{640, 480};
  return 0;
}

int V4l2StandIn::interval_at(v4l2_frmivalenum& it) {
  if (it.index >= 2) return fails(EINVAL);
  it.type = V4L2_FRMIVAL_TYPE_DISCRETE;
  it.discrete = {1, it.index == 0 ? 30u : 15u};
  return 0;
}

int V4l2StandIn::set_format(v4l2_format& it) {
  width_ = fault == V4l2Fault::OtherSize ? 320 : it.fmt.pix.width;
  height_ = fault == V4l2Fault::OtherSize ? 240 : it.fmt.pix.height;
  fourcc_ = it.fmt.pix.pixelformat;
  it.fmt.pix.width = width_;
  it.fmt.pix.height = height_;
  it.fmt.pix.bytesperline = width_ * (fourcc_ == V4L2_PIX_FMT_YUYV ? 2 : 1);
  it.fmt.pix.sizeimage = it.fmt.pix.bytesperline * height_;
  return 0;
}

int V4l2StandIn::set_control(const v4l2_control& it) {
  if (it.id == V4L2_CID_AUTOGAIN) return fails(EINVAL);  // it has none
  if (it.id == V4L2_CID_GAIN && it.value > 255) return fails(ERANGE);
  controls[it.id] = it.value;
  return 0;
}

/// The next picture, in the buffer that was queued first.
int V4l2StandIn::give(v4l2_buffer& it) {
  if (!is_on_ || queued_.empty()) return wrong();
  if (fault == V4l2Fault::Unplugged && count_ >= 3) {
    gone_ = true;
    return fails(ENODEV);
  }
  if (fault == V4l2Fault::IoError && count_ >= 3) return fails(EIO);
  while (std::find(lost.begin(), lost.end(), number_) != lost.end()) ++number_;
  it.index = queued_.front();
  queued_.erase(queued_.begin());
  auto& bytes = memory_[it.index];
  std::fill(bytes.begin(), bytes.end(), (unsigned char)(10 * count_));
  if (!pixels.empty() && pixels.total() == bytes.size())
    std::memcpy(bytes.data(), pixels.data, bytes.size());
  it.bytesused = __u32(bytes.size());
  it.sequence = number_++;
  it.flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
  double stamp_s = monotonic_clock_s() - stamp_age_s;
  if (fault == V4l2Fault::WrongClock) stamp_s = 1.7e9;
  const bool is_corrupt = fault == V4l2Fault::Corrupt && count_ == 2;
  const bool is_short = fault == V4l2Fault::CutShort && count_ == 2;
  if (is_corrupt || fault == V4l2Fault::AllCorrupt) it.flags |= V4L2_BUF_FLAG_ERROR;
  if (is_short || fault == V4l2Fault::AllCutShort) it.bytesused /= 2;
  if (fault == V4l2Fault::BadIndex && count_ >= 2) it.index = 9;
  it.timestamp.tv_sec = time_t(stamp_s);
  it.timestamp.tv_usec = suseconds_t((stamp_s - std::floor(stamp_s)) * 1e6);
  ++count_;
  return 0;
}

int V4l2StandIn::wait_readable(int, int wait_ms) {
  const bool is_silent = fault == V4l2Fault::Silent && count_ >= 3;
  const int pause_ms = is_silent ? wait_ms : std::min(period_ms, wait_ms);
  std::this_thread::sleep_for(std::chrono::milliseconds(pause_ms));
  return is_silent || period_ms > wait_ms ? 0 : 1;
}

int V4l2StandIn::control(int descriptor, unsigned long request, void* argument) {
  if (descriptor != kDescriptor) return wrong();
  switch (request) {
    case VIDIOC_QUERYCAP:
      return capabilities(*static_cast<v4l2_capability*>(argument), fault);
    case VIDIOC_ENUM_FMT:
      return format_at(*static_cast<v4l2_fmtdesc*>(argument));
    case VIDIOC_ENUM_FRAMESIZES:
      return size_at(*static_cast<v4l2_frmsizeenum*>(argument));
    case VIDIOC_ENUM_FRAMEINTERVALS:
      return interval_at(*static_cast<v4l2_frmivalenum*>(argument));
    case VIDIOC_S_FMT:
      return set_format(*static_cast<v4l2_format*>(argument));
    case VIDIOC_S_PARM: {
      const v4l2_fract& t = static_cast<v4l2_streamparm*>(argument)->parm.capture.timeperframe;
      rate_hz = double(t.denominator) / t.numerator;
      return 0;
    }
    case VIDIOC_S_CTRL:
      return set_control(*static_cast<v4l2_control*>(argument));
    case VIDIOC_REQBUFS:
      return fault == V4l2Fault::NoMemory ? fails(ENOMEM) : 0;
    case VIDIOC_QUERYBUF: {
      auto& it = *static_cast<v4l2_buffer*>(argument);
      it.length = width_ * height_ * (fourcc_ == V4L2_PIX_FMT_YUYV ? 2 : 1);
      it.m.offset = __u32(it.index * kStride);
      return 0;
    }
    case VIDIOC_QBUF:
      queued_.push_back(static_cast<v4l2_buffer*>(argument)->index);
      return 0;
    case VIDIOC_STREAMON:
      if (fault == V4l2Fault::NoBandwidth) return fails(ENOSPC);
      is_on_ = true;
      return 0;
    case VIDIOC_STREAMOFF:
      is_on_ = false;
      return 0;
    case VIDIOC_DQBUF:
      return give(*static_cast<v4l2_buffer*>(argument));
    default:
      return wrong();
  }
}

}  // namespace kestrel::test
