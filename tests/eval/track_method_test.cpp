#include "kestrel/eval/track_method.hpp"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace kestrel {
namespace {

/// Squares of chance in front of grey: corners enough for SIFT.
cv::Mat textured(int shift_px) {
  cv::Mat gray(160, 240, CV_8UC1, cv::Scalar(128));
  test::Random random("squares");
  for (int i = 0; i < 120; ++i) {
    const int size = random.integer(4, 12);
    const cv::Rect square(40 + random.integer(0, 100) + shift_px, 20 + random.integer(0, 100), size,
                          size);
    gray(square).setTo(cv::Scalar(random.integer(0, 255)));
  }
  return gray;
}

constexpr PixelBox kBox{45, 25, 100, 90};

TEST(TrackMethod, SaysWhatTheTrackerSays) {
  const TrackOptions options;
  const BenchMethod method = track_method("hybrid", options);
  EXPECT_EQ(method.name, "hybrid");
  BenchTracker bench = method.learn(textured(0), kBox);
  Tracker tracker(textured(0), kBox, options);
  TrackState state = tracker.start(240, 160);
  for (int k = 0; k < 3; ++k) {
    const Frame frame{k, k / 30.0, textured(4 * k), std::nullopt};
    const BenchAnswer answer = bench(frame);
    const Track seen = tracker.track(frame, state);
    state = seen.next;
    ASSERT_TRUE(seen.found());
    ASSERT_TRUE(answer.image_from_template);
    EXPECT_EQ(answer.image_from_template->H, seen.image_from_template->H);
    EXPECT_EQ(answer.window.u, seen.window.u);
    EXPECT_EQ(answer.window.width, seen.window.width);
    EXPECT_EQ(answer.keypoints, seen.keypoints);
    EXPECT_EQ(answer.matches, seen.matches);
    EXPECT_EQ(answer.inliers, int(seen.inliers.size()));
    EXPECT_EQ(answer.state, "found");
  }
}

TEST(TrackMethod, SaysWhyNothingWasFound) {
  BenchTracker tracker = track_method("hybrid", {}).learn(textured(0), kBox);
  const BenchAnswer answer =
      tracker({1, 0, cv::Mat(160, 240, CV_8UC1, cv::Scalar(9)), std::nullopt});
  EXPECT_FALSE(answer.image_from_template);
  EXPECT_EQ(answer.state, "few_keypoints");
}

TEST(TrackMethod, RefusesATemplateWithoutTextureAndOptionsOutOfRange) {
  const BenchMethod method = track_method("paper", {});
  EXPECT_THROW(method.learn(cv::Mat(160, 240, CV_8UC1, cv::Scalar(9)), kBox),
               std::invalid_argument);
  TrackOptions options;
  options.max_outline_deviation_px = -1;
  EXPECT_THROW(track_method("paper", options), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel
