#include "kestrel/io/live_camera.hpp"

#include <chrono>
#include <cmath>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <stdexcept>
#include <thread>

#include <fmt/format.h>

#include "kestrel/io/dc1394_camera.hpp"
#include "kestrel/io/gray_image.hpp"
#include "kestrel/io/module.hpp"
#include "kestrel/io/text_file.hpp"

#include "capture_module.hpp"

namespace kestrel {
namespace {

using Clock = std::chrono::steady_clock;

bool begins_with(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

const CaptureModule& capture_module() { return module_functions<CaptureModule>("capture"); }

CaptureModule::Images open_device(const std::string& address) {
  std::int64_t number = -1;
  try {
    number = parse_integer(address.substr(address.find(':') + 1));
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(address + ": " + error.what() + ", e.g. camera:0");
  }
  const std::string device = fmt::format("/dev/video{}", number);
  if (!std::filesystem::exists(device)) {
    throw std::runtime_error(address + ": there is no " + device +
                             "; connect the camera, or name another (ls /dev/video*)");
  }
  auto images = capture_module().open_device(int(number));
  if (!images) {
    throw std::runtime_error(address + ": " + device +
                             " cannot be opened; check its permissions, and that no other program "
                             "holds it");
  }
  return images;
}

/// FFmpeg's own time-out comes after ours, so that a stall is called one.
CaptureModule::Images open_stream(const std::string& address, const LiveOptions& options) {
  auto images = capture_module().open_stream(address, int(1000 * options.open_timeout_s),
                                             int(1500 * options.stall_timeout_s));
  if (!images) {
    throw std::runtime_error(address + fmt::format(": no video within {} s; check the address, and "
                                                   "that the camera sends",
                                                   options.open_timeout_s));
  }
  return images;
}

/// The newest frame of a capture that a thread of its own reads.
class LiveCamera : public FrameSource, public LiveClock {
 public:
  LiveCamera(std::string address, CaptureModule::Images images, double stall_timeout_s)
      : address_(std::move(address)),
        stall_timeout_s_(stall_timeout_s),
        images_(std::move(images)),
        reader_([this] { read_all(); }) {}
  /// Waits for the reader: as long as the capture's own time-out at most.
  ~LiveCamera() override {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      stop_ = true;
    }
    reader_.join();
  }
  LiveCamera(const LiveCamera&) = delete;
  LiveCamera& operator=(const LiveCamera&) = delete;

  std::optional<Frame> next() override {
    std::unique_lock<std::mutex> lock(mutex_);
    const bool news = changed_.wait_for(lock, std::chrono::duration<double>(stall_timeout_s_),
                                        [this] { return latest_.has_value() || ended_; });
    if (!news) {
      throw std::runtime_error(
          address_ + fmt::format(": no frame for {} s; check the camera and its connection",
                                 stall_timeout_s_));
    }
    if (!latest_) throw std::runtime_error(address_ + ": the stream ended; check the camera");
    std::optional<Frame> frame;
    frame.swap(latest_);
    return frame;
  }

  const std::vector<std::string>& skipped() const override { return skipped_; }
  std::optional<std::int64_t> frame_count() const override { return std::nullopt; }
  double stamp_origin_s() const override {
    return std::chrono::duration<double>(start_.time_since_epoch()).count();
  }

 private:
  void read_all() {
    std::int64_t index = 0;
    for (cv::Mat image = images_(); !image.empty(); image = images_(), ++index) {
      const double stamp_s = std::chrono::duration<double>(Clock::now() - start_).count();
      cv::Mat gray = as_gray(image);
      const std::lock_guard<std::mutex> lock(mutex_);
      if (stop_) return;
      if (gray.empty()) continue;
      latest_ = Frame{index, stamp_s, std::move(gray), std::nullopt};
      changed_.notify_one();
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    ended_ = true;
    changed_.notify_one();
  }

  const std::string address_;
  const double stall_timeout_s_;
  const Clock::time_point start_ = Clock::now();
  const std::vector<std::string> skipped_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Frame> latest_;
  bool ended_ = false;
  bool stop_ = false;
  CaptureModule::Images images_;
  std::thread reader_;  // the last member: it starts when all else is there
};

}  // namespace

void LiveOptions::check() const {
  const auto require = [](const char* key, double value) {
    if (!(std::isfinite(value) && value > 0)) {
      throw std::invalid_argument(std::string(key) + ": must be positive and finite (s)");
    }
  };
  require("open_timeout_s", open_timeout_s);
  require("stall_timeout_s", stall_timeout_s);
}

std::unique_ptr<FrameSource> open_live(const std::string& address, const LiveOptions& options) {
  options.check();
  if (address == "dc1394" || begins_with(address, "dc1394:")) {
    const auto colon = address.find(':');
    const std::string guid = colon == std::string::npos ? "" : address.substr(colon + 1);
    return open_dc1394(guid, options.stall_timeout_s);
  }
  if (begins_with(address, "camera:")) {
    return std::make_unique<LiveCamera>(address, open_device(address), options.stall_timeout_s);
  }
  for (const char* start : {"http://", "rtsp://", "udp://"}) {
    if (!begins_with(address, start)) continue;
    return std::make_unique<LiveCamera>(address, open_stream(address, options),
                                        options.stall_timeout_s);
  }
  throw std::runtime_error("'" + address +
                           "' is no live camera; give camera:N, dc1394:GUID, or an address that "
                           "begins with http://, rtsp:// or udp://");
}

std::optional<double> stamp_origin_s(const FrameSource& source) {
  const auto* live = dynamic_cast<const LiveClock*>(&source);
  return live != nullptr ? std::optional(live->stamp_origin_s()) : std::nullopt;
}

}  // namespace kestrel
