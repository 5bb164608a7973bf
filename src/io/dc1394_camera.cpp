#include "kestrel/io/dc1394_camera.hpp"

#include <charconv>
#include <chrono>
#include <stdexcept>
#include <thread>

#include <dc1394/dc1394.h>
#include <fmt/format.h>

#include "kestrel/io/live_camera.hpp"

namespace kestrel {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t kBuffers = 4;
constexpr auto kPollInterval = std::chrono::milliseconds(1);

/// The modes in which a frame is taken, the best first.
constexpr dc1394video_mode_t kModes[] = {
    DC1394_VIDEO_MODE_640x480_MONO8,  DC1394_VIDEO_MODE_800x600_MONO8,
    DC1394_VIDEO_MODE_1024x768_MONO8, DC1394_VIDEO_MODE_1280x960_MONO8,
    DC1394_VIDEO_MODE_640x480_YUV411, DC1394_VIDEO_MODE_640x480_YUV422,
    DC1394_VIDEO_MODE_640x480_RGB8};

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error("dc1394: " + what); }

void require(dc1394error_t error, const char* doing) {
  if (error != DC1394_SUCCESS) fail(fmt::format("{}: {}", doing, dc1394_error_get_string(error)));
}

/// Releases with the library's own functions.
struct Release {
  void operator()(dc1394_t* bus) const { dc1394_free(bus); }
  void operator()(dc1394camera_list_t* list) const { dc1394_camera_free_list(list); }
  void operator()(dc1394camera_t* camera) const { dc1394_camera_free(camera); }
};

std::uint64_t guid_of(const dc1394camera_list_t& list, const std::string& wanted) {
  if (list.num == 0) fail("no camera on the FireWire bus; connect one, and check /dev/fw*");
  if (wanted.empty()) return list.ids[0].guid;
  std::uint64_t guid = 0;
  const char* end = wanted.data() + wanted.size();
  const auto read = std::from_chars(wanted.data(), end, guid, 16);
  if (read.ec != std::errc() || read.ptr != end) {
    fail("'" + wanted + "' is no GUID; give 16 hexadecimal digits");
  }
  std::string others;
  for (std::uint32_t i = 0; i < list.num; ++i) {
    if (list.ids[i].guid == guid) return guid;
    others += fmt::format(" {:016x}", list.ids[i].guid);
  }
  fail(fmt::format("no camera {:016x} on the bus; there is{}", guid, others));
}

class Dc1394Camera : public FrameSource, public LiveClock {
 public:
  Dc1394Camera(const std::string& guid, double timeout_s)
      : timeout_(
            std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(timeout_s))),
        bus_(dc1394_new()) {
    if (!bus_) fail("the FireWire bus cannot be opened; check /dev/fw* and its permissions");
    dc1394camera_list_t* list = nullptr;
    require(dc1394_camera_enumerate(bus_.get(), &list), "looking for cameras");
    const std::unique_ptr<dc1394camera_list_t, Release> cameras(list);
    camera_.reset(dc1394_camera_new(bus_.get(), guid_of(*cameras, guid)));
    if (!camera_) fail("the camera cannot be opened; check the permissions of /dev/fw*");
    choose_mode();
    require(dc1394_capture_setup(camera_.get(), kBuffers, DC1394_CAPTURE_FLAGS_DEFAULT),
            "reserving the bus");
    const dc1394error_t error = dc1394_video_set_transmission(camera_.get(), DC1394_ON);
    if (error != DC1394_SUCCESS) dc1394_capture_stop(camera_.get());
    require(error, "starting the camera");
  }
  ~Dc1394Camera() override {
    dc1394_video_set_transmission(camera_.get(), DC1394_OFF);
    dc1394_capture_stop(camera_.get());
  }
  Dc1394Camera(const Dc1394Camera&) = delete;
  Dc1394Camera& operator=(const Dc1394Camera&) = delete;

  std::optional<Frame> next() override {
    for (const auto deadline = Clock::now() + timeout_; Clock::now() < deadline;) {
      dc1394video_frame_t* raw = nullptr;
      require(dc1394_capture_dequeue(camera_.get(), DC1394_CAPTURE_POLICY_POLL, &raw),
              "taking a frame; check the cable");
      if (raw == nullptr) {
        std::this_thread::sleep_for(kPollInterval);
        continue;
      }
      const std::int64_t index = index_++;
      const bool corrupt = dc1394_capture_is_frame_corrupt(camera_.get(), raw) == DC1394_TRUE;
      const bool newest = raw->frames_behind == 0;
      if (corrupt) skipped_.push_back(fmt::format("frame {}: it arrived corrupt", index));
      const double stamp_s = std::chrono::duration<double>(Clock::now() - start_).count();
      cv::Mat gray;
      if (newest && !corrupt) gray = gray_of(*raw);
      require(dc1394_capture_enqueue(camera_.get(), raw), "giving a frame back");
      if (!gray.empty()) return Frame{index, stamp_s, gray, std::nullopt};
    }
    fail(fmt::format("no frame for {} s; check that the camera is still connected",
                     std::chrono::duration<double>(timeout_).count()));
  }

  const std::vector<std::string>& skipped() const override { return skipped_; }
  std::optional<std::int64_t> frame_count() const override { return std::nullopt; }
  double stamp_origin_s() const override {
    return std::chrono::duration<double>(start_.time_since_epoch()).count();
  }

 private:
  void choose_mode() {
    dc1394video_modes_t modes;
    require(dc1394_video_get_supported_modes(camera_.get(), &modes), "asking for its modes");
    for (const dc1394video_mode_t mode : kModes) {
      for (std::uint32_t i = 0; i < modes.num; ++i) {
        if (modes.modes[i] == mode) return set_mode(mode);
      }
    }
    fail("the camera has none of the modes that are read (8-bit grey, 640x480 YUV or RGB)");
  }

  void set_mode(dc1394video_mode_t mode) {
    require(dc1394_video_set_iso_speed(camera_.get(), DC1394_ISO_SPEED_400), "setting the speed");
    require(dc1394_video_set_mode(camera_.get(), mode), "setting the mode");
    dc1394framerates_t rates;
    require(dc1394_video_get_supported_framerates(camera_.get(), mode, &rates),
            "asking for its rates");
    if (rates.num == 0) fail("the camera names no frame rate");
    dc1394framerate_t highest = rates.framerates[0];
    for (std::uint32_t i = 1; i < rates.num; ++i) highest = std::max(highest, rates.framerates[i]);
    require(dc1394_video_set_framerate(camera_.get(), highest), "setting the rate");
  }

  /// The frame's pixels, copied out of the ring buffer.
  static cv::Mat gray_of(const dc1394video_frame_t& raw) {
    cv::Mat gray(int(raw.size[1]), int(raw.size[0]), CV_8UC1);
    if (raw.color_coding == DC1394_COLOR_CODING_MONO8) {
      cv::Mat(gray.rows, gray.cols, CV_8UC1, raw.image, raw.stride).copyTo(gray);
    } else {
      require(dc1394_convert_to_MONO8(raw.image, gray.data, raw.size[0], raw.size[1],
                                      raw.yuv_byte_order, raw.color_coding, raw.data_depth),
              "turning a frame to grey");
    }
    return gray;
  }

  const Clock::time_point start_ = Clock::now();
  Clock::duration timeout_;
  std::unique_ptr<dc1394_t, Release> bus_;
  std::unique_ptr<dc1394camera_t, Release> camera_;
  std::int64_t index_ = 0;
  std::vector<std::string> skipped_;
};

}  // namespace

std::unique_ptr<FrameSource> open_dc1394(const std::string& guid, double timeout_s) {
  return std::make_unique<Dc1394Camera>(guid, timeout_s);
}

}  // namespace kestrel
