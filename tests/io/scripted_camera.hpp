#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <thread>

#include "kestrel/io/camera_device.hpp"
#include "kestrel/io/live_options.hpp"

namespace kestrel::test {

/// What a camera that is made up does; changed while it runs.
struct CameraScript {
  std::atomic<bool> is_there{true};    // else it does not open, and what is open breaks
  std::atomic<bool> is_silent{false};  // open, but sends nothing
  std::atomic<int> width_px{8};
  std::atomic<int> openings{0};
  std::atomic<int> attempts{0};  // openings that failed too
  std::atomic<int> sent{0};
  std::atomic<int> damaged_every{0};  // each picture of this number is damaged; 0: none
};

/// A camera that sends a picture every 5 ms, picture k of grey value k % 250, and does what its
/// script says.
class ScriptedCamera : public CameraDevice {
 public:
  explicit ScriptedCamera(CameraScript& script) : script_(script) {
    ++script_.attempts;
    if (!script_.is_there) throw std::runtime_error("scripted: no such camera; connect one");
    ++script_.openings;
  }
  std::optional<Picture> next() override {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    if (!script_.is_there) throw std::runtime_error("scripted: unplugged");
    if (script_.is_silent) return std::nullopt;
    const int k = script_.sent++;
    const int every = script_.damaged_every;
    if (every > 0 && k % every == every - 1)
      return Picture{cv::Mat(), monotonic_clock_s(), 0, "came damaged"};
    return Picture{cv::Mat(6, script_.width_px, CV_8UC1, cv::Scalar(k % 250)), monotonic_clock_s(),
                   0, ""};
  }
  CaptureClock clock() const override { return CaptureClock::Driver; }

 private:
  CameraScript& script_;
};

inline OpenCamera opener(CameraScript& script) {
  return [&script](const StopAsked&, double) { return std::make_unique<ScriptedCamera>(script); };
}

/// Short times, so that the tests are; their order is that of the defaults.
inline LiveOptions quick() {
  LiveOptions options;
  options.open_timeout_s = 0.3;
  options.stall_timeout_s = 20;
  options.blind_s = 0.03;
  options.give_up_s = 20;
  options.retry_s = 0.01;
  options.longest_retry_s = 0.02;
  return options;
}

}  // namespace kestrel::test
