#pragma once

#include <atomic>
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>

#include "kestrel/io/camera_device.hpp"
#include "kestrel/sim/texture.hpp"

#include "stamped_picture.hpp"

namespace kestrel {

/// Draws into FFmpeg's input until it is told to stop.
class StampedSender {
 public:
  explicit StampedSender(const std::string& output)
      : pipe_(popen(("ffmpeg -loglevel error -probesize 32 -f rawvideo -pix_fmt gray -s 320x240 "
                     "-framerate 25 -i - -an -threads 1 -pix_fmt yuv420p " +
                     output)
                        .c_str(),
                    "w")),
        thread_([this] { draw(); }) {}
  ~StampedSender() {
    stop_ = true;
    thread_.join();
    pclose(pipe_);
  }
  StampedSender(const StampedSender&) = delete;
  StampedSender& operator=(const StampedSender&) = delete;

 private:
  void draw() {
    const cv::Mat picture = poster(120, 120, 7);
    while (!stop_) {
      const cv::Mat now = stamped(picture, monotonic_clock_s());
      if (std::fwrite(now.data, 1, now.total(), pipe_) != now.total()) return;
      std::fflush(pipe_);
      std::this_thread::sleep_for(std::chrono::milliseconds(kPeriod_ms));
    }
  }
  std::atomic<bool> stop_{false};
  std::FILE* pipe_;
  std::thread thread_;
};

}  // namespace kestrel
