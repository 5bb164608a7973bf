// What a camera and a clock may do wrong.
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "kestrel/vision/tracker.hpp"

#include "support/planted_target.hpp"

namespace kestrel {
namespace {

using test::error_px;
using test::frame_of;
using test::learned_place;
using test::options_of;
using test::placed_at;
using test::planted;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kFrame_s = 0.04;

cv::Mat flat(double grey) {
  return {test::kGroundHeight, test::kGroundWidth, CV_8UC1, cv::Scalar(grey)};
}

class TrackerFaults : public testing::TestWithParam<TrackMethod> {
 protected:
  Tracker& tracker() { return test::shared_tracker(GetParam()); }
  TrackState start() { return tracker().start(test::kGroundWidth, test::kGroundHeight); }

  /// After three frames of the target drifting 3 px a frame from its learned place; the last one at
  /// 2 kFrame_s.
  TrackState tracking() {
    TrackState state = start();
    for (int k = 0; k < 3; ++k) {
      state = tracker().track(frame_of(planted(drift(k)), k * kFrame_s), state).next;
    }
    return state;
  }

  static Homography drift(int k) { return placed_at({199.5 + 3 * k, 149.5}); }
};

INSTANTIATE_TEST_SUITE_P(Methods, TrackerFaults,
                         testing::Values(TrackMethod::Detect, TrackMethod::Hybrid),
                         [](const auto& method) { return std::string(name(method.param)); });

TEST_P(TrackerFaults, FindsNothingWhereNothingIs) {
  test::Random random("nothing");
  cv::Mat noise = flat(128);
  test::add_noise(noise, 60, random);
  cv::Mat burnt;
  planted(learned_place()).convertTo(burnt, CV_8U, 1, 250);
  cv::Mat mirrored;
  cv::flip(planted(learned_place()), mirrored, 1);
  const std::vector<cv::Mat> images{
      flat(0),        flat(255),
      flat(90),       noise,
      burnt,          mirrored,
      test::ground(), test::texture(test::kGroundWidth, test::kGroundHeight, random)};
  for (const TrackState& state : {start(), tracking()}) {
    for (std::size_t i = 0; i < images.size(); ++i) {
      const Track seen = tracker().track(frame_of(images[i], 3 * kFrame_s), state);
      EXPECT_FALSE(seen.found()) << i;
      EXPECT_NE(seen.miss, Miss::None) << i;
      EXPECT_EQ(seen.status, state.motion ? TrackStatus::Coasting : TrackStatus::Lost) << i;
    }
  }
  EXPECT_EQ(tracker().track(frame_of(flat(0), 0), start()).miss, Miss::FewKeypoints);
}

TEST_P(TrackerFaults, IsNotWrongInSaturationAndInTheDark) {
  cv::Mat harsh;
  planted(drift(0)).convertTo(harsh, CV_8U, 30, -128 * 29);  // black and white only
  cv::Mat dark;
  planted(drift(0)).convertTo(dark, CV_8U, 0.01);  // three grey levels
  for (const cv::Mat& image : {harsh, dark}) {
    const Track seen = tracker().track(frame_of(image, 0), start());
    EXPECT_LT(seen.found() ? error_px(*seen.image_from_template, drift(0)) : 0, 2);
  }
}

TEST_P(TrackerFaults, IsNotWrongWhenHalfOfTheImageIsNotWritten) {
  for (const int rows : {75, 150, 225}) {
    cv::Mat torn = planted(drift(3));
    torn.rowRange(rows, torn.rows).setTo(128);
    const Track seen = tracker().track(frame_of(torn, 3 * kFrame_s), tracking());
    // 150 of 300 rows hold half of the target: that much may be covered.
    EXPECT_EQ(seen.found(), rows >= 150) << rows;
    if (!seen.found()) continue;
    // The lower corners follow from the upper half, whose slope is known to about a hundredth.
    EXPECT_LT(error_px(*seen.image_from_template, drift(3)), 1);
  }
}

TEST_P(TrackerFaults, WaitsWithoutAnImage) {
  const std::array<cv::Mat, 3> images{cv::Mat(), cv::Mat(300, 400, CV_8UC3, cv::Scalar::all(9)),
                                      cv::Mat(300, 400, CV_32F, cv::Scalar(9))};
  for (const cv::Mat& image : images) {
    for (const TrackState& state : {start(), tracking()}) {
      const Track seen = tracker().track(frame_of(image, 3 * kFrame_s), state);
      EXPECT_EQ(seen.miss, Miss::NoImage);
      EXPECT_FALSE(seen.found());
      EXPECT_EQ(seen.next.window.u, state.window.u);
      EXPECT_EQ(seen.next.window.width, state.window.width);
      EXPECT_EQ(seen.next.last_seen->H, state.last_seen->H);
      EXPECT_EQ(seen.status, state.motion ? TrackStatus::Coasting : TrackStatus::Lost);
    }
  }
  const Track coasting = tracker().track(frame_of({}, 3 * kFrame_s), tracking());
  EXPECT_LT(error_px(*coasting.predicted, drift(3)), 0.5);
  const Track after = tracker().track(frame_of(planted(drift(4)), 4 * kFrame_s), coasting.next);
  EXPECT_TRUE(after.found());
}

TEST_P(TrackerFaults, GoesOnWhenTheImageChangesItsSize) {
  const cv::Mat small = planted(drift(3))(cv::Rect(100, 60, 220, 190)).clone();
  const Track seen = tracker().track(frame_of(small, 3 * kFrame_s), tracking());
  ASSERT_TRUE(seen.found()) << name(seen.miss);
  const Homography shifted = test::product(test::translation(-100, -60), drift(3));
  EXPECT_LT(error_px(*seen.image_from_template, shifted), 0.2);
  // From there to an image the last place is outside of, and to ones that hold nothing.
  cv::Mat far(600, 800, CV_8UC1, cv::Scalar(128));
  test::plant(far, placed_at({650, 480}));
  const Track again = tracker().track(frame_of(far, 4 * kFrame_s), seen.next);
  ASSERT_TRUE(again.found()) << name(again.miss);
  EXPECT_LT(error_px(*again.image_from_template, placed_at({650, 480})), 0.2);
  for (const cv::Size& size :
       {cv::Size(1, 1), cv::Size(5, 4), cv::Size(400, 2), cv::Size(3, 300)}) {
    const Track none =
        tracker().track(frame_of(cv::Mat(size, CV_8UC1, cv::Scalar(7)), 5 * kFrame_s), again.next);
    EXPECT_FALSE(none.found());
  }
}

TEST_P(TrackerFaults, KeepsItsSpeedOverAFrameThatComesTwice) {
  TrackState state = tracking();
  const Track twice = tracker().track(frame_of(planted(drift(2)), 2 * kFrame_s), state);
  ASSERT_TRUE(twice.found());
  EXPECT_LT(error_px(*twice.image_from_template, drift(2)), 0.2);
  // What comes next is not seen, but expected where the speed leads.
  const Track next = tracker().track(frame_of(flat(128), 4 * kFrame_s), twice.next);
  ASSERT_EQ(next.status, TrackStatus::Coasting);
  EXPECT_LT(error_px(*next.predicted, drift(4)), 1);
  // The same stamp without the target: a sight of this very moment is not lost.
  const Track hidden = tracker().track(frame_of(flat(128), 2 * kFrame_s), state);
  EXPECT_EQ(hidden.status, TrackStatus::Coasting);
  EXPECT_EQ(hidden.age_s, 0);
}

TEST_P(TrackerFaults, FindsWhateverTheClockSays) {
  for (const double stamp_s : {kNaN, -10.0, std::numeric_limits<double>::infinity(), 1e300}) {
    const Track seen = tracker().track(frame_of(planted(drift(3)), stamp_s), tracking());
    ASSERT_TRUE(seen.found()) << stamp_s;
    EXPECT_LT(error_px(*seen.image_from_template, drift(3)), 0.2);
    const Track next = tracker().track(frame_of(planted(drift(4)), 4 * kFrame_s), seen.next);
    ASSERT_TRUE(next.found()) << stamp_s;
    const Track hidden = tracker().track(frame_of(flat(0), 5 * kFrame_s), next.next);
    EXPECT_EQ(hidden.status, TrackStatus::Coasting) << stamp_s;
    EXPECT_NEAR(hidden.age_s, kFrame_s, 1e-9);
    const Track unclear = tracker().track(frame_of(flat(0), stamp_s), tracking());
    EXPECT_EQ(unclear.status, TrackStatus::Lost);
    EXPECT_TRUE(std::isfinite(unclear.age_s)) << stamp_s;
    const Track missed = tracker().track(frame_of(flat(0), 4 * kFrame_s), seen.next);
    EXPECT_TRUE(std::isfinite(missed.age_s)) << stamp_s;
  }
}

TEST_P(TrackerFaults, FindsWhateverItIsToldOfThePast) {
  TrackState state = tracking();
  state.window = {kNaN, 0, 10, 10};
  state.last_seen->H.setConstant(kNaN);
  for (CoordinateMotion& c : state.motion->coordinates) c.mean.setConstant(kNaN);
  const Track seen = tracker().track(frame_of(planted(drift(3)), 3 * kFrame_s), state);
  ASSERT_TRUE(seen.found()) << name(seen.miss);
  EXPECT_LT(error_px(*seen.image_from_template, drift(3)), 0.2);
  const Track next = tracker().track(frame_of(planted(drift(4)), 4 * kFrame_s), seen.next);
  EXPECT_TRUE(next.found());
}

TEST_P(TrackerFaults, TracksATemplateThatCoversTheWholeFrame) {
  const cv::Mat& picture = test::target_picture();
  const int width = picture.cols;
  const int height = picture.rows;
  const PixelBox all{0, 0, double(width), double(height)};
  Tracker whole(picture, all, options_of(GetParam()));
  TrackState state = whole.start(width, height);
  for (int k = 0; k < 10; ++k) {
    const Homography truth =
        test::moved({1 + 0.02 * k, 0.01 * k, 0, 0}, test::kTargetCentre, {79.5 + 2 * k, 63.5});
    const Track seen =
        whole.track(frame_of(test::view(picture, truth, width, height), k * kFrame_s), state);
    ASSERT_TRUE(seen.found()) << k << " " << name(seen.miss);
    EXPECT_LT(error_px(*seen.image_from_template, truth), 0.2) << k;
    state = seen.next;
  }
}

TEST_P(TrackerFaults, RefusesTheSmallestTemplateAndDoesNotMistakeASmallOne) {
  const cv::Mat image = planted(learned_place());
  const TrackOptions options = options_of(GetParam());
  EXPECT_THROW(Tracker(image, {130, 90, 16, 16}, options), std::invalid_argument);
  Tracker small(image, {170, 110, 64, 64}, options);
  test::Random random("another ground");
  for (int i = 0; i < 10; ++i) {
    const cv::Mat other = test::texture(test::kGroundWidth, test::kGroundHeight, random);
    TrackState state = small.start(other.cols, other.rows);
    EXPECT_FALSE(small.track(frame_of(other, 0), state).found()) << i;
  }
}

}  // namespace
}  // namespace kestrel
