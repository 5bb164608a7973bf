#pragma once

#include <atomic>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "kestrel/eval/bench.hpp"
#include "kestrel/eval/bench_run.hpp"

namespace kestrel::test {

/// A target that moves one pixel to the right in each frame; nothing is to be seen in its frames.
class MadeUpSource : public FrameSource {
 public:
  explicit MadeUpSource(std::int64_t frames, std::int64_t first = 0)
      : next_(first), end_(first + frames) {}
  std::optional<Frame> next() override {
    if (next_ == end_) return std::nullopt;
    const std::int64_t index = next_++;
    return Frame{index, double(index), cv::Mat(60, 80, CV_8UC1, cv::Scalar(double(index % 256))),
                 std::nullopt};
  }
  const std::vector<std::string>& skipped() const override { return skipped_; }
  std::optional<std::int64_t> frame_count() const override { return std::nullopt; }

 private:
  std::int64_t next_;
  std::int64_t end_;
  std::vector<std::string> skipped_;
};

inline constexpr PixelBox kBox{10, 20, 31, 21};

inline Corners corners_at(double shift_px) {
  return {{{10 + shift_px, 20}, {40 + shift_px, 20}, {40 + shift_px, 40}, {10 + shift_px, 40}}};
}

/// That sequence with labels in all its frames.
inline BenchSequence made_up_sequence(const std::string& name, std::int64_t frames,
                                      std::int64_t first = 0) {
  BenchSequence sequence;
  sequence.name = name;
  sequence.open = [frames, first] { return std::make_unique<MadeUpSource>(frames, first); };
  sequence.template_px = kBox;
  for (std::int64_t k = 0; k < frames; ++k) sequence.truth[first + k] = corners_at(double(k));
  return sequence;
}

/// What a tracker says that puts the target this far to the right of where the template was.
inline BenchAnswer answer_at(double shift_px) {
  BenchAnswer answer;
  answer.image_from_template = Homography{};
  answer.image_from_template->H(0, 2) = kBox.u + shift_px;
  answer.image_from_template->H(1, 2) = kBox.v;
  answer.window = {1, 2, 30, 40};
  answer.keypoints = 100;
  answer.matches = 20;
  answer.inliers = 10;
  answer.state = "found";
  return answer;
}

/// A method that is always this far off, and counts how often it learned.
inline BenchMethod made_up_method(const std::string& name, double off_px,
                                  std::atomic<int>* learned = nullptr) {
  return {name, [off_px, learned](const cv::Mat&, const PixelBox&) -> BenchTracker {
            if (learned != nullptr) ++*learned;
            return [off_px, k = 0](const Frame&) mutable { return answer_at(k++ + off_px); };
          }};
}

inline BenchMethod refusing_method() {
  return {"refusing", [](const cv::Mat&, const PixelBox&) -> BenchTracker {
            throw std::invalid_argument("too little texture, really");
          }};
}

/// A clock that goes a millisecond further each time it is read; never interrupted.
inline BenchHooks made_up_hooks() {
  return {[now_s = 0.0]() mutable { return now_s += 1e-3; }, [] { return false; }, [] {}};
}

/// The run of a method that is this far off over a sequence.
inline BenchRun made_up_run(const BenchSequence& sequence, double off_px) {
  return *run_bench(sequence, made_up_method("made up", off_px), made_up_hooks());
}

}  // namespace kestrel::test
