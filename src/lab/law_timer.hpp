#pragma once

#include "kestrel/lab/camera_run.hpp"

namespace kestrel {

/// Times a law in one call of sixteen: the processor time of a thread costs a system call to read,
/// a microsecond where a law takes ten.
class LawTimer {
 public:
  /// An empty clock times nothing.
  explicit LawTimer(const LabClock& clock) : clock_(clock) {}

  /// What the law answers.
  template <class Law>
  auto timed(const Law& law) {
    const bool is_timed = clock_ && calls_++ % kEvery == 0;
    if (!is_timed) return law();
    const double begin_s = clock_();
    auto answer = law();
    timed_s_ += clock_() - begin_s;
    ++timed_;
    return answer;
  }

  /// Spent in all calls, s: the mean of those timed stands for the others.
  double all_s() const { return timed_ > 0 ? timed_s_ * calls_ / timed_ : 0; }

 private:
  static constexpr int kEvery = 16;
  LabClock clock_;
  int calls_ = 0;
  int timed_ = 0;
  double timed_s_ = 0;
};

}  // namespace kestrel
