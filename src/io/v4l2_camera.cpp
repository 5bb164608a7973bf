#include "kestrel/io/v4l2_camera.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "kestrel/io/raw_picture.hpp"
#include "kestrel/io/text_file.hpp"

#include "v4l2_buffers.hpp"

namespace kestrel {
namespace {

constexpr int kWait_ms = 100;
constexpr double kOldest_s = 10;  // a stamp older than that is of another clock

std::string path_of(const std::string& place) {
  if (!place.empty() && place[0] == '/') return place;
  try {
    return fmt::format("/dev/video{}", parse_integer(place));
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error("camera:" + place + ": " + error.what() +
                             "; write e.g. camera:0 or camera:/dev/video0");
  }
}

std::vector<std::string> read_formats() {
  std::vector<std::string> names;
  for (const RawFormat format : raw_formats()) names.emplace_back(name(format));
  return names;
}

/// Sets a control when a value is asked for.
void set_control(const V4l2Device& device, __u32 id, std::optional<double> value,
                 const char* what) {
  if (!value) return;
  v4l2_control control{};
  control.id = id;
  control.value = int(std::lround(*value));
  if (device.control(VIDIOC_S_CTRL, control)) return;
  const bool is_range = errno == ERANGE;
  device.fail(std::string(what) + (is_range ? ": the value is out of its range; choose another"
                                            : ": it has no such setting; remove the key"));
}

void set_controls(const V4l2Device& device, const CaptureSettings& settings) {
  if (settings.exposure_s) {
    set_control(device, V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_MANUAL, "exposure_s");
    constexpr double kUnit_s = 100e-6;  // of V4L2_CID_EXPOSURE_ABSOLUTE
    set_control(device, V4L2_CID_EXPOSURE_ABSOLUTE, *settings.exposure_s / kUnit_s, "exposure_s");
  }
  if (settings.gain) {
    v4l2_control automatic{};
    automatic.id = V4L2_CID_AUTOGAIN;
    device.control(VIDIOC_S_CTRL, automatic);  // many cameras have none to switch off
    set_control(device, V4L2_CID_GAIN, settings.gain, "gain");
  }
}

class V4l2Camera : public CameraDevice {
 public:
  V4l2Camera(const std::string& path, const CaptureSettings& settings, DeviceCalls& calls)
      : device_(path, calls) {
    if (!captures_video(capability(device_)))
      device_.fail("it captures no video; choose another ('kestrel cameras' lists them)");
    set_mode(settings);
    set_controls(device_, settings);
    buffers_ = std::make_unique<V4l2Buffers>(device_);
    int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    device_.require(VIDIOC_STREAMON, type, "it does not start");
  }
  ~V4l2Camera() override {
    int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    device_.control(VIDIOC_STREAMOFF, type);
  }
  V4l2Camera(const V4l2Camera&) = delete;
  V4l2Camera& operator=(const V4l2Camera&) = delete;

  std::optional<Picture> next() override;
  CaptureClock clock() const override { return clock_; }

 private:
  void set_mode(const CaptureSettings& settings);
  void set_rate(double rate_hz) const;
  Picture picture_of(const v4l2_buffer& buffer);
  double captured_s(const v4l2_buffer& buffer);

  V4l2Device device_;  // first: closed last
  RawFormat format_ = RawFormat::Grey;
  cv::Size size_;
  std::size_t row_bytes_ = 0;
  CaptureClock clock_ = CaptureClock::Driver;
  std::optional<__u32> last_sequence_;
  std::unique_ptr<V4l2Buffers> buffers_;
};

void V4l2Camera::set_mode(const CaptureSettings& settings) {
  ChosenMode chosen;
  try {
    chosen = choose_mode(modes_of(device_, settings.size), settings, read_formats());
  } catch (const std::runtime_error& error) {
    device_.fail(error.what());
  }
  v4l2_format set{};
  set.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  set.fmt.pix.width = __u32(chosen.mode.size.width);
  set.fmt.pix.height = __u32(chosen.mode.size.height);
  set.fmt.pix.pixelformat = fourcc_of(chosen.mode.format);
  set.fmt.pix.field = V4L2_FIELD_NONE;
  device_.require(VIDIOC_S_FMT, set, "its mode cannot be set");
  size_ = {int(set.fmt.pix.width), int(set.fmt.pix.height)};
  const std::string got = format_name(set.fmt.pix.pixelformat);
  if (size_ != chosen.mode.size || got != chosen.mode.format) {
    device_.fail(fmt::format("asked for {} it set {}; choose another format or size",
                             to_string({chosen.mode.format, chosen.mode.size, {}}),
                             to_string({got, size_, {}})));
  }
  format_ = *raw_format_named(got);
  row_bytes_ = format_ == RawFormat::Mjpeg ? 0 : set.fmt.pix.bytesperline;
  if (chosen.rate_hz > 0) set_rate(chosen.rate_hz);
}

/// As near as the driver can; the stamps say what it came to.
void V4l2Camera::set_rate(double rate_hz) const {
  constexpr double kParts = 1000;
  v4l2_streamparm set{};
  set.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  set.parm.capture.timeperframe = {__u32(kParts), __u32(std::lround(kParts * rate_hz))};
  device_.control(VIDIOC_S_PARM, set);
}

std::optional<Picture> V4l2Camera::next() {
  const int ready = device_.calls().wait_readable(device_.descriptor(), kWait_ms);
  if (ready < 0) device_.fail_with_cause("the camera was unplugged");
  if (ready == 0) return std::nullopt;
  v4l2_buffer buffer = V4l2Buffers::buffer(0);
  if (!device_.control(VIDIOC_DQBUF, buffer)) {
    if (errno == EAGAIN) return std::nullopt;
    device_.fail_with_cause(errno == ENODEV ? "the camera was unplugged" : "taking a picture");
  }
  if (buffer.index >= buffers_->count())
    device_.fail("the driver names memory that it did not give");
  Picture picture = picture_of(buffer);
  device_.require(VIDIOC_QBUF, buffer, "it does not take its memory back");
  return picture;
}

Picture V4l2Camera::picture_of(const v4l2_buffer& buffer) {
  Picture picture;
  picture.captured_s = captured_s(buffer);
  if (last_sequence_ && buffer.sequence > *last_sequence_)
    picture.lost = std::int64_t(buffer.sequence - *last_sequence_) - 1;
  last_sequence_ = buffer.sequence;
  const V4l2Buffers::Part& part = (*buffers_)[buffer.index];
  if ((buffer.flags & V4L2_BUF_FLAG_ERROR) != 0) {
    picture.damage = "came damaged, says its driver";
    return picture;
  }
  const std::size_t count = std::min<std::size_t>(buffer.bytesused, part.bytes);
  picture.gray =
      gray_of(format_, {static_cast<unsigned char*>(part.start), count, row_bytes_}, size_);
  if (picture.gray.empty()) picture.damage = "came cut short";
  return picture;
}

/// The driver's stamp where it is of the monotonic clock and can be true, else now.
double V4l2Camera::captured_s(const v4l2_buffer& buffer) {
  const double now_s = monotonic_clock_s();
  const double stamp_s = double(buffer.timestamp.tv_sec) + 1e-6 * double(buffer.timestamp.tv_usec);
  const bool is_monotonic =
      (buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
  const bool is_true = is_monotonic && stamp_s <= now_s + 1e-3 && stamp_s > now_s - kOldest_s;
  clock_ = is_true ? CaptureClock::Driver : CaptureClock::Arrival;
  return is_true ? std::min(stamp_s, now_s) : now_s;
}

}  // namespace

std::unique_ptr<CameraDevice> open_v4l2(const std::string& place, const CaptureSettings& settings,
                                        DeviceCalls& calls) {
  return std::make_unique<V4l2Camera>(path_of(place), settings, calls);
}

}  // namespace kestrel
