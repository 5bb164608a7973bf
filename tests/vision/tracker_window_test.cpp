// Where keypoints are looked for, on larger frames: longer than the fast tests may be.
#include <algorithm>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "kestrel/vision/tracker.hpp"

#include "support/planted_target.hpp"

namespace kestrel {
namespace {

using test::frame_of;
using test::placed_at;
using test::planted;

constexpr double kFrame_s = 0.04;
constexpr double kWholeFrame = double(test::kGroundWidth) * test::kGroundHeight;

TrackOptions detect(WindowPolicy window) {
  TrackOptions options = test::options_of(TrackMethod::Detect);
  options.window = window;
  return options;
}

double area(const PixelBox& box) { return box.width * box.height; }

/// Larger than twice the target, so that a window can lie elsewhere: the ground in its middle.
cv::Mat wide_scene(const Homography& target) {
  static const cv::Mat ground = [] {
    test::Random random("wide ground");
    return test::texture(900, 600, random);
  }();
  cv::Mat image = ground.clone();
  test::plant(image, target);
  return image;
}

TEST(TrackerWindow, FixedStaysWhereTheTargetWasLastSeen) {
  Tracker tracker = test::tracker_of(detect(WindowPolicy::Fixed));
  TrackState state = tracker.start(900, 600);
  // Near the corner, where the window is cut, and at half its size.
  const Homography near = placed_at({90, 80}, {0.5, 0, 0, 0});
  state.window = {0, 0, 300, 250};
  Track seen = tracker.track(frame_of(wide_scene(near), 0), state);
  ASSERT_TRUE(seen.found()) << name(seen.miss);
  const Homography away = placed_at({700, 400});
  PixelBox first;
  for (int k = 1; k <= 5; ++k) {
    seen = tracker.track(frame_of(wide_scene(away), k * kFrame_s), seen.next);
    EXPECT_FALSE(seen.found()) << k;
    EXPECT_LE(seen.window.width, 2 * test::kTargetWidth + 1);  // whole pixels
    EXPECT_LE(seen.window.height, 2 * test::kTargetHeight + 1);
    if (k == 1) first = seen.window;
    EXPECT_EQ(seen.window.u, first.u) << k;
    EXPECT_EQ(seen.window.width, first.width) << k;
    EXPECT_EQ(seen.window.height, first.height) << k;
  }
  EXPECT_TRUE(tracker.track(frame_of(wide_scene(near), 1), seen.next).found());
}

TEST(TrackerWindow, DoublingGrowsToTheWholeImage) {
  Tracker tracker = test::tracker_of(detect(WindowPolicy::Doubling));
  TrackState state = tracker.start(900, 600);
  state.window = {0, 0, 160, 160};
  const cv::Mat image = wide_scene(placed_at({700, 400}));
  double expected = 160 * 160;
  for (int k = 0; k < 8; ++k) {
    const Track seen = tracker.track(frame_of(image, k * kFrame_s), state);
    if (seen.found()) {
      EXPECT_GT(k, 2);
      EXPECT_LT(test::error_px(*seen.image_from_template, placed_at({700, 400})), 0.2);
      return;
    }
    EXPECT_NEAR(area(seen.window), expected, 0.05 * expected);  // searched on whole pixels
    expected = std::min(2 * expected, 900.0 * 600);
    state = seen.next;
  }
  FAIL() << "not found again";
}

TEST(TrackerWindow, KalmanFollowsTheMotionAndSeesTheWholeFrameOnAMiss) {
  Tracker tracker = test::tracker_of(detect(WindowPolicy::Kalman));
  const auto drift = [](int k) { return placed_at({200 + 8.0 * k, 200}); };
  TrackState state = tracker.start(900, 600);
  for (int k = 0; k < 8; ++k) {
    const Track seen = tracker.track(frame_of(wide_scene(drift(k)), k * kFrame_s), state);
    ASSERT_TRUE(seen.found()) << k << " " << name(seen.miss);
    if (k >= 3) {
      EXPECT_LT(area(seen.window), 2.5 * 240 * 192);  // 1.5 times each side, and the uncertainty
      // Centred ahead of where it was last.
      EXPECT_NEAR(centre(seen.window).u, 200 + 8.0 * k, 2);
    }
    state = seen.next;
  }
  // It jumped: found in the same frame, outside the window.
  const Homography away = placed_at({700, 420});
  const Track seen = tracker.track(frame_of(wide_scene(away), 8 * kFrame_s), state);
  ASSERT_TRUE(seen.found()) << name(seen.miss);
  EXPECT_LT(test::error_px(*seen.image_from_template, away), 0.2);
}

TEST(TrackerWindow, BudgetIsKeptAndStripsCoverTheFrameInTurn) {
  TrackOptions options = detect(WindowPolicy::Kalman);
  options.detect.max_px_per_frame = 48000;  // strips of 120 rows, 60 apart
  Tracker tracker = test::tracker_of(options);
  TrackState lost = tracker.start(test::kGroundWidth, test::kGroundHeight);
  lost = tracker.track(frame_of(planted(test::learned_place()), 0), lost).next;
  cv::Mat covered(test::kGroundHeight, test::kGroundWidth, CV_8UC1, cv::Scalar(0));
  constexpr int kTurns = 4;  // (300 - 120) / 80, rounded up, and one
  TrackState state = lost;
  for (int k = 0; k < kTurns; ++k) {
    const Track seen = tracker.track(frame_of(test::ground(), 10 + k * kFrame_s), state);
    EXPECT_FALSE(seen.found());
    const PixelBox& w = seen.window;
    EXPECT_LE(area(w), 48000);
    covered(cv::Rect(int(w.u), int(w.v), int(w.width), int(w.height))).setTo(1);
    state = seen.next;
  }
  EXPECT_EQ(cv::countNonZero(covered), int(kWholeFrame));
  for (const double v : {64.0, 120.0, 180.0, 235.0}) {
    const Homography truth = placed_at({240, v});
    state = lost;
    int frames = 0;
    bool is_found = false;
    for (; frames < kTurns && !is_found; ++frames) {
      const Track seen = tracker.track(frame_of(planted(truth), 10 + frames * kFrame_s), state);
      is_found = seen.found();
      state = seen.next;
    }
    EXPECT_TRUE(is_found) << v;
  }
}

/// The target's upper left part is the template: it is lost, and comes back elsewhere at half, once
/// or twice its size, turned by any angle. It is found in the first frame that shows it.
TEST(TrackerWindow, ASmallTemplateIsFoundInTheFirstFrameItIsBack) {
  for (const auto& [width, height] : {std::pair(64, 52), std::pair(96, 76), std::pair(128, 102)}) {
    const PixelBox box{test::kLearnedAt.u, test::kLearnedAt.v, double(width), double(height)};
    Tracker tracker(planted(test::learned_place()), box, test::options_of(TrackMethod::Hybrid));
    TrackState state = tracker.start(test::kGroundWidth, test::kGroundHeight);
    state = tracker.track(frame_of(planted(test::learned_place()), 0), state).next;
    state = tracker.track(frame_of(test::ground(), kFrame_s), state).next;
    const TrackState lost = tracker.track(frame_of(test::ground(), 5), state).next;
    for (const double scale : {0.5, 1.0, 2.0}) {
      for (int turn = 0; turn <= 6; ++turn) {
        const Homography truth = test::moved({scale, turn * M_PI / 6, 0, 0},
                                             {(width - 1) / 2., (height - 1) / 2.}, {230, 140});
        const Track seen = tracker.track(frame_of(planted(truth), 6), lost);
        ASSERT_TRUE(seen.found()) << width << " " << scale << " " << turn << name(seen.miss);
        // Few blocks at half the size, and bilinear rendering: half a pixel.
        EXPECT_LT(test::corner_distance(*seen.image_from_template, truth, width, height), 0.5)
            << width << " " << scale << " " << turn;
      }
    }
  }
}

/// Two targets of the same picture.
cv::Mat twins(const Homography& one, const Homography& other) {
  cv::Mat image = test::ground();
  test::plant(image, one);
  test::plant(image, other);
  cv::addWeighted(image, 1, test::noise_of_ground(), 1, -128, image);
  return image;
}

TEST(TrackerWindow, OfTwoEqualTargetsTheExpectedOneIsTaken) {
  Tracker tracker = test::tracker_of(detect(WindowPolicy::Kalman));
  const Homography left = placed_at({85, 100});
  const Homography right = placed_at({300.4, 195.3});
  TrackState everywhere = tracker.start(test::kGroundWidth, test::kGroundHeight);
  everywhere.window = {0, 0, test::kGroundWidth, test::kGroundHeight};
  const Track unknown = tracker.track(frame_of(twins(left, right), 0), everywhere);
  EXPECT_FALSE(unknown.found());
  EXPECT_EQ(unknown.miss, Miss::Ambiguous);
  for (const Homography& one : {left, right}) {
    const TrackState state = tracker.track(frame_of(planted(one), 0), everywhere).next;
    const Track seen = tracker.track(frame_of(twins(left, right), kFrame_s), state);
    ASSERT_TRUE(seen.found()) << name(seen.miss);
    EXPECT_LT(test::error_px(*seen.image_from_template, one), 0.2);
  }
}

}  // namespace
}  // namespace kestrel
