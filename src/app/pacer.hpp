#pragma once

#include <chrono>
#include <thread>

#include "arguments.hpp"
#include "progress.hpp"

namespace kestrel::app {

/// Waits until a frame of a recording is due on a clock that started with its first frame.
class Pacer {
 public:
  explicit Pacer(Pace pace) : pace_(pace) {}
  void wait_for(double stamp_s) {
    if (pace_ == Pace::AsFastAsPossible) return;
    if (!started_) {
      started_ = true;
      offset_s_ = monotonic_s() - stamp_s;
    }
    const double wait_s = stamp_s + offset_s_ - monotonic_s();
    if (wait_s > 0) std::this_thread::sleep_for(std::chrono::duration<double>(wait_s));
  }

 private:
  Pace pace_;
  bool started_ = false;
  double offset_s_ = 0;
};

}  // namespace kestrel::app
