#pragma once

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include <linux/videodev2.h>

#include "kestrel/io/camera_device.hpp"
#include "kestrel/io/device_calls.hpp"

namespace kestrel::test {

/// What a camera behind the stand-in does wrong.
enum class V4l2Fault {
  None,
  Busy,         // it does not open: EBUSY
  Forbidden,    // EACCES
  NoCapture,    // a node that captures no video (the metadata node of a webcam)
  OtherSize,    // it sets another size than it was asked for
  NoMemory,     // REQBUFS fails: ENOMEM
  NoBandwidth,  // STREAMON fails: ENOSPC
  Corrupt,      // picture 2 is marked as faulty
  CutShort,     // picture 2 is half as long
  AllCorrupt,   // every picture is
  AllCutShort,  // every picture is
  IoError,      // taking picture 3 and those after it fails: EIO
  Unplugged,    // from picture 3 on: ENODEV, and it does not open any more
  Silent,       // no picture after the third
  WrongClock,   // stamps of CLOCK_REALTIME
  BadIndex,     // names a buffer that was never given
};

/// A V4L2 camera in memory, at one path: it keeps the driver's side of the protocol (and says
/// EINVAL where a caller breaks it), sends a picture whenever it is waited for, and has faults.
/// Picture k is all of grey value 10 k; the driver's count passes over the numbers in `lost`.
class V4l2StandIn : public DeviceCalls {
 public:
  explicit V4l2StandIn(std::string path = "/dev/video0") : path_(std::move(path)) {}

  std::atomic<V4l2Fault> fault{V4l2Fault::None};
  std::vector<__u32> lost;     // counts of pictures that are passed over
  double stamp_age_s = 0.005;  // how long before it can be had a picture was captured
  int period_ms = 0;           // between pictures; 0: whenever one is waited for
  cv::Mat pixels;              // of every picture, when it is as large; empty: all of 10 k
  std::map<__u32, int> controls;
  double rate_hz = 0;  // as it was set
  int open_descriptors = 0;
  int mapped = 0;
  int wrong_calls = 0;  // that a driver would refuse

  int open(const std::string& path) override {
    if (path != path_ || gone_) return fails(ENOENT);
    if (fault == V4l2Fault::Busy) return fails(EBUSY);
    if (fault == V4l2Fault::Forbidden) return fails(EACCES);
    ++open_descriptors;
    return kDescriptor;
  }
  void close(int) override {
    --open_descriptors;
    is_on_ = false;
    queued_.clear();
  }
  int control(int descriptor, unsigned long request, void* argument) override;
  void* map(int, std::size_t bytes, std::size_t offset) override {
    ++mapped;
    const std::size_t index = offset / kStride;
    memory_[index].assign(bytes, 0);
    return memory_[index].data();
  }
  void unmap(void*, std::size_t) override { --mapped; }
  int wait_readable(int, int wait_ms) override;
  /// Plugs it in again.
  void plug_in() {
    gone_ = false;
    fault = V4l2Fault::None;
  }

 private:
  static constexpr int kDescriptor = 77;
  static constexpr std::size_t kStride = 1 << 20;

  static int fails(int cause) {
    errno = cause;
    return -1;
  }
  int wrong() {
    ++wrong_calls;
    return fails(EINVAL);
  }
  static int capabilities(v4l2_capability& it, V4l2Fault fault);
  static int format_at(v4l2_fmtdesc& it);
  static int size_at(v4l2_frmsizeenum& it);
  static int interval_at(v4l2_frmivalenum& it);
  int set_format(v4l2_format& it);
  int set_control(const v4l2_control& it);
  int give(v4l2_buffer& it);

  const std::string path_;
  std::atomic<bool> gone_{false};
  bool is_on_ = false;
  __u32 width_ = 0;
  __u32 height_ = 0;
  __u32 fourcc_ = 0;
  __u32 count_ = 0;   // pictures taken
  __u32 number_ = 0;  // the driver's count
  std::vector<__u32> queued_;
  std::array<std::vector<unsigned char>, 8> memory_;
};

}  // namespace kestrel::test
