// What a tracker makes of the way the target moves.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "kestrel/vision/corner_motion.hpp"
#include "kestrel/vision/tracker.hpp"

#include "support/planted_target.hpp"

namespace kestrel {
namespace {

constexpr double kFrame_s = 0.04;

/// The state after the target was seen at these columns, a frame each.
TrackState seen_at(Tracker& tracker, const std::vector<double>& u_px) {
  TrackState state = tracker.start(test::kGroundWidth, test::kGroundHeight);
  for (std::size_t k = 0; k < u_px.size(); ++k) {
    const Frame frame =
        test::frame_of(test::planted(test::placed_at({u_px[k], 150})), double(k) * kFrame_s);
    const Track seen = tracker.track(frame, state);
    EXPECT_TRUE(seen.found()) << k;
    state = seen.next;
  }
  return state;
}

double speed_px_s(const TrackState& state) { return state.motion->coordinates[0].mean[1]; }

TEST(TrackerMotion, AJumpIsTheBeginningOfAnotherMotion) {
  Tracker& tracker = test::shared_tracker(TrackMethod::Hybrid);
  const TrackState after = seen_at(tracker, {180, 180, 180, 180, 180, 180, 210});
  EXPECT_EQ(speed_px_s(after), 0);  // 750 px/s would be believed of a body that has no mass
  const double first = MotionOptions{}.first_speed_px_s;
  EXPECT_NEAR(after.motion->coordinates[0].covariance(1, 1), first * first, 1);
}

/// Pushed as hard as MotionOptions::acceleration_px_s2 expects it, the filter goes along: its speed
/// is right to three of its own standard deviations.
TEST(TrackerMotion, WhatIsAsLivelyAsExpectedGoesOn) {
  Tracker& tracker = test::shared_tracker(TrackMethod::Hybrid);
  const double push_px_s2 = MotionOptions{}.acceleration_px_s2;
  std::vector<double> u_px;
  for (int k = 0; k < 8; ++k) u_px.push_back(140 + push_px_s2 * std::pow(k * kFrame_s, 2) / 2);
  const TrackState after = seen_at(tracker, u_px);
  const double deviation_px_s = std::sqrt(after.motion->coordinates[0].covariance(1, 1));
  EXPECT_NEAR(speed_px_s(after), push_px_s2 * 7 * kFrame_s, 3 * deviation_px_s);
  EXPECT_LT(deviation_px_s, MotionOptions{}.first_speed_px_s / 2);
}

/// Pixels alone would place what has no noise to a hundredth of a pixel, which no plane is flat to.
TEST(TrackerMotion, IsNeverSurerThanPlanesAreFlat) {
  cv::Mat image = test::ground();
  test::plant(image, test::learned_place());
  Tracker tracker(image, test::kLearnedAt, {});
  TrackState state = tracker.start(test::kGroundWidth, test::kGroundHeight);
  for (int k = 0; k < 8; ++k)
    state = tracker.track(test::frame_of(image, k * kFrame_s), state).next;
  EXPECT_GT(state.motion->deviation_px(), 0.05);
  EXPECT_LT(state.motion->deviation_px(), 0.2);
}

/// What holds the predicted corners to three standard deviations, and a quarter of that more.
TEST(TrackerMotion, KeypointsAreLookedForWhereItLeads) {
  Tracker& tracker = test::shared_tracker(TrackMethod::Detect);
  const TrackState state = seen_at(tracker, {110, 110, 110, 110});
  const double next_s = 4 * kFrame_s;
  const PixelBox box = gate(predicted(*state.motion, next_s, {}), 3);
  const double by_px = std::max(box.width, box.height) / 4;
  const Frame frame = test::frame_of(test::planted(test::placed_at({110, 150})), next_s);
  const PixelBox window = tracker.track(frame, state).window;
  ASSERT_LT(window.u + window.width, test::kGroundWidth - 20);
  EXPECT_NEAR(window.u + window.width, box.u + box.width + by_px, 1);
  EXPECT_NEAR(window.v, std::max(box.v - by_px, 0.0), 1);
}

/// Covered by more than half for as long as keypoints are asked and know nothing of it.
TEST(TrackerMotion, AWeakAnswerIsBetterThanNone) {
  TrackOptions options = test::options_of(TrackMethod::Hybrid);
  options.detect.fit.min_inliers = 100;  // more than it has
  Tracker tracker = test::tracker_of(options);
  const Homography truth = test::placed_at({210, 150});
  cv::Mat covered = test::planted(truth);
  covered(cv::Rect(130, 80, 88, 140)).setTo(128);
  TrackState state = tracker.start(test::kGroundWidth, test::kGroundHeight);
  state.last_seen = truth;
  for (int k = 0; k < 2 * options.weak_frames; ++k) {
    const Track seen = tracker.track(test::frame_of(covered, k * kFrame_s), state);
    ASSERT_TRUE(seen.found()) << k;
    EXPECT_EQ(seen.stage, TrackStage::Aligned) << k;
    state = seen.next;
  }
}

}  // namespace
}  // namespace kestrel
