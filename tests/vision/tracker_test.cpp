#include "kestrel/vision/tracker.hpp"

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "support/planted_target.hpp"

namespace kestrel {
namespace {

using test::error_px;
using test::frame_of;
using test::options_of;
using test::placed_at;
using test::planted;

constexpr double kFrame_s = 0.04;

TrackState start_of(const Tracker& tracker) {
  return tracker.start(test::kGroundWidth, test::kGroundHeight);
}

/// A target that flies a loop, turns, nears and tilts; u and v to 4 px a frame.
Homography flight(int k) {
  const double a = 0.08 * k;
  return placed_at({200 + 50 * std::sin(a), 150 + 35 * std::sin(1.3 * a)},
                   {1 + 0.25 * std::sin(0.7 * a), 0.4 * std::sin(0.9 * a), 0.5 * std::sin(a), 1});
}

/// The target's motion at constant speed, px a frame.
Homography drift(int k) { return placed_at({150 + 3.0 * k, 130 + 1.0 * k}); }

class TrackerOfPixels : public testing::TestWithParam<TrackMethod> {
 protected:
  Tracker& tracker() { return test::shared_tracker(GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(Methods, TrackerOfPixels,
                         testing::Values(TrackMethod::Detect, TrackMethod::Hybrid),
                         [](const auto& method) { return std::string(name(method.param)); });

TEST_P(TrackerOfPixels, StartsWithAWindowTwiceTheTemplate) {
  const TrackState state = start_of(tracker());
  EXPECT_EQ(state.window.width, 2 * test::kTargetWidth);
  EXPECT_EQ(state.window.height, 2 * test::kTargetHeight);
  ASSERT_TRUE(state.last_seen);
  EXPECT_EQ(state.last_seen->H, test::learned_place().H);
  EXPECT_FALSE(state.motion);
}

TEST_P(TrackerOfPixels, FollowsAMovingView) {
  TrackState state = start_of(tracker());
  state.last_seen = flight(0);
  const bool is_detection = GetParam() == TrackMethod::Detect;
  for (int k = 0; k < (is_detection ? 15 : 60); ++k) {
    const Track seen = tracker().track(frame_of(planted(flight(k)), k * kFrame_s), state);
    ASSERT_EQ(seen.status, TrackStatus::Found) << k;
    // Bilinear rendering and sampling at changed scale blur by different amounts: a tenth of a px.
    EXPECT_LT(error_px(*seen.image_from_template, flight(k)), 0.25) << k;
    EXPECT_GT(seen.confidence, 0.6);
    EXPECT_EQ(seen.age_s, 0);
    EXPECT_EQ(seen.miss, Miss::None);
    EXPECT_FALSE(seen.predicted);
    EXPECT_EQ(seen.stage, is_detection ? TrackStage::Detected : TrackStage::Aligned) << k;
    state = seen.next;
  }
}

TEST_P(TrackerOfPixels, TellsHowFarTheCornersMayBeOff) {
  TrackState state = start_of(tracker());
  const Track seen = tracker().track(frame_of(planted(test::learned_place()), 0), state);
  ASSERT_TRUE(seen.found());
  for (int i = 0; i < 8; ++i) {
    EXPECT_GT(seen.corner_covariance(i, i), 0);
    EXPECT_LT(seen.corner_covariance(i, i), 0.25);  // half a pixel: all of it is visible
  }
}

TEST_P(TrackerOfPixels, CoastsForAWhileAndIsThenLost) {
  TrackState state = start_of(tracker());
  int k = 0;
  for (; k < 10; ++k) {
    state = tracker().track(frame_of(planted(drift(k)), k * kFrame_s), state).next;
  }
  const int last = k - 1;
  const double coast_s = tracker().options().coast_s;
  double confidence = 1;
  double variance = 0;
  for (; k < last + 16; ++k) {
    const double age_s = (k - last) * kFrame_s;
    const Track seen = tracker().track(frame_of(test::ground(), k * kFrame_s), state);
    state = seen.next;
    EXPECT_FALSE(seen.found());
    EXPECT_NE(seen.miss, Miss::None);
    EXPECT_NEAR(seen.age_s, age_s, 1e-9) << k;
    if (age_s > coast_s + 1e-9) {
      EXPECT_EQ(seen.status, TrackStatus::Lost) << k;
      EXPECT_FALSE(seen.predicted);
      EXPECT_EQ(seen.confidence, 0);
      continue;
    }
    if (age_s > coast_s - 1e-9) continue;  // rounding decides
    ASSERT_EQ(seen.status, TrackStatus::Coasting) << k;
    // A speed known from ten frames to a tenth of a px a frame, carried on.
    EXPECT_LT(error_px(*seen.predicted, drift(k)), 0.5 + 0.2 * (k - last)) << k;
    EXPECT_LT(seen.confidence, confidence);
    EXPECT_GE(seen.confidence, 0);
    EXPECT_GT(seen.corner_covariance(0, 0), variance);
    confidence = seen.confidence;
    variance = seen.corner_covariance(0, 0);
  }
}

TEST_P(TrackerOfPixels, FindsAgainOnTheFirstFrameWhereTheObjectIsBackElsewhere) {
  TrackState lost = start_of(tracker());
  for (int k = 0; k < 3; ++k) {
    lost = tracker().track(frame_of(planted(drift(k)), k * kFrame_s), lost).next;
  }
  for (const double stamp_s : {0.2, 1.0, 2.0}) {
    const Track seen = tracker().track(frame_of(test::ground(), stamp_s), lost);
    EXPECT_EQ(seen.status, stamp_s < 0.5 ? TrackStatus::Coasting : TrackStatus::Lost);
    lost = seen.next;
  }
  for (const double scale : {0.5, 1.0, 2.0}) {
    const Pixel there = scale > 1 ? Pixel{210, 160} : Pixel{300, 200};
    const Homography truth = placed_at(there, {scale, 0.3, 0.2, 0});
    const Track seen = tracker().track(frame_of(planted(truth), 2.04), lost);
    ASSERT_TRUE(seen.found()) << scale << " " << name(seen.miss);
    EXPECT_EQ(seen.stage, TrackStage::Detected);
    // The template at half its size shows a pixel of its own in every second one.
    EXPECT_LT(error_px(*seen.image_from_template, truth), 0.6) << scale;
  }
}

TEST_P(TrackerOfPixels, FindsAtAnyRotation) {
  for (int k = 0; k < 16; ++k) {
    TrackState lost = start_of(tracker());
    const Homography truth = placed_at({210, 150}, {1, 2 * M_PI * k / 16, 0, 0});
    const Track seen = tracker().track(frame_of(planted(truth), 5), lost);
    ASSERT_TRUE(seen.found()) << k << " " << name(seen.miss);
    EXPECT_LT(error_px(*seen.image_from_template, truth), 0.25) << k;
  }
}

TEST_P(TrackerOfPixels, FindsJumpsAtOneFrameASecond) {
  TrackState state = start_of(tracker());
  const std::array<Pixel, 5> stops{{{120, 120}, {270, 190}, {130, 190}, {290, 120}, {200, 150}}};
  for (std::size_t k = 0; k < stops.size(); ++k) {
    const Homography truth = placed_at(stops[k], {1, 0.5 * double(k), 0.2, 0});
    const Track seen = tracker().track(frame_of(planted(truth), double(k)), state);
    ASSERT_TRUE(seen.found()) << k << " " << name(seen.miss);
    EXPECT_LT(error_px(*seen.image_from_template, truth), 0.25) << k;
    state = seen.next;
  }
}

TEST_P(TrackerOfPixels, IsAFunctionOfItsArguments) {
  TrackState state = start_of(tracker());
  state = tracker().track(frame_of(planted(drift(0)), 0), state).next;
  for (const Homography& truth : {drift(1), placed_at({280, 190}, {0.8, 1, 0.3, 0})}) {
    const Frame frame = frame_of(planted(truth), kFrame_s);
    const Track first = tracker().track(frame, state);
    EXPECT_TRUE(first.found());
    tracker().track(frame_of(test::ground(), 7), state);  // something else in between
    EXPECT_TRUE(test::same(first, tracker().track(frame, state)));
  }
}

TEST(Tracker, OfThePaperIsThePaperS) {
  Tracker tracker = test::tracker_of(options_of(TrackMethod::Paper));
  const Track seen = tracker.track(frame_of(planted(drift(3)), 0), start_of(tracker));
  ASSERT_TRUE(seen.found());
  EXPECT_GT(seen.trials, 0);
  EXPECT_LT(error_px(*seen.image_from_template, drift(3)), 1);
  EXPECT_EQ(seen.agreement.fine.blocks, 0);
}

/// More than half of the target covered.
cv::Mat half_covered(const Homography& truth) {
  cv::Mat image = planted(truth);
  const Pixel first = truth * Pixel{0, 0};
  image(cv::Rect(int(first.u), int(first.v), 88, test::kTargetHeight)).setTo(128);
  return image;
}

TEST(Tracker, AsksForKeypointsAfterSeveralWeakAnswers) {
  Tracker& tracker = test::shared_tracker(TrackMethod::Hybrid);
  const Homography truth = placed_at({110.5, 90.5});
  TrackState state = start_of(tracker);
  state.last_seen = truth;
  const int patience = tracker.options().weak_frames;
  for (int k = 1; k <= 2 * patience; ++k) {
    const Track seen = tracker.track(frame_of(half_covered(truth), k * kFrame_s), state);
    ASSERT_TRUE(seen.found()) << k;
    EXPECT_LT(error_px(*seen.image_from_template, truth), 0.5);
    EXPECT_EQ(seen.next.weak_frames, k % patience);
    state = seen.next;
  }
  const Track clear = tracker.track(frame_of(planted(truth), 1), state);
  EXPECT_EQ(clear.next.weak_frames, 0);
}

TEST(Tracker, TakesTheBetterOfTwoAnswersWhenInDoubt) {
  // What it follows is half covered; another one, whole, stands in view.
  Tracker& tracker = test::shared_tracker(TrackMethod::Hybrid);
  const Homography covered = placed_at({90.5, 80.5});
  const Homography whole = placed_at({300, 210});
  cv::Mat image = half_covered(covered);
  test::plant(image, whole);
  TrackState state = start_of(tracker);
  state.last_seen = covered;
  const int patience = tracker.options().weak_frames;
  for (int k = 1; k <= patience; ++k) {
    const Track seen = tracker.track(frame_of(image, k), state);
    ASSERT_TRUE(seen.found()) << k;
    const Homography& truth = k < patience ? covered : whole;
    EXPECT_LT(error_px(*seen.image_from_template, truth), 0.5) << k;
    EXPECT_EQ(seen.stage, k < patience ? TrackStage::Aligned : TrackStage::Detected) << k;
    state = seen.next;
  }
}

TEST(Tracker, GoesOnAfterItIsMoved) {
  Tracker first = test::tracker_of({});
  Tracker moved = std::move(first);
  EXPECT_TRUE(moved.track(frame_of(planted(drift(3)), 0), start_of(moved)).found());
  EXPECT_EQ(moved.options().method, TrackMethod::Hybrid);
  EXPECT_EQ(moved.model().width(), test::kTargetWidth);
}

}  // namespace
}  // namespace kestrel
