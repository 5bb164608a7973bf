#include "kestrel/vision/paper_track.hpp"

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "kestrel/vision/outline_deviation.hpp"
#include "kestrel/vision/window.hpp"

#include "support/random.hpp"
#include "support/rendered_view.hpp"

namespace kestrel {
namespace {

constexpr int kWidth = 200;
constexpr int kHeight = 160;
const PixelBox kBox{60, 50, 90, 70};
const Pixel kCentre{104.5, 84.5};
const TrackOptions kPaper = [] {
  TrackOptions options;
  options.method = TrackMethod::Paper;
  return options;
}();
const double kNaN = std::numeric_limits<double>::quiet_NaN();

const cv::Mat& scene() {
  static const cv::Mat image = [] {
    test::Random random("track scene");
    return test::texture(kWidth, kHeight, random);
  }();
  return image;
}

const Template& model() {
  static const Template learned(scene(), kBox, kPaper);
  return learned;
}

Frame frame_of(const cv::Mat& gray, std::int64_t index = 0) {
  Frame frame;
  frame.index = index;
  frame.gray = gray;
  return frame;
}

TrackState looking_at(const PixelBox& window) {
  TrackState state;
  state.window = window;
  return state;
}

TrackState everywhere() { return looking_at({0, 0, kWidth, kHeight}); }

/// The scene moved as a whole; the truth is the motion after the rectangle's place.
Track track_view(const Homography& motion, const TrackState& state, double noise = 2) {
  test::Random random("view noise");
  cv::Mat image = test::view(scene(), motion, kWidth, kHeight);
  test::add_noise(image, noise, random);
  return paper_track(model(), frame_of(image), state, kPaper);
}

Homography truth(const Homography& motion) {
  return test::product(motion, test::translation(kBox.u, kBox.v));
}

bool same(const Track& a, const Track& b) {
  return a.found() == b.found() && a.miss == b.miss && a.matches == b.matches &&
         a.trials == b.trials && a.inliers.size() == b.inliers.size() &&
         a.next.window.u == b.next.window.u && a.next.window.width == b.next.window.width &&
         (!a.found() || a.image_from_template->H == b.image_from_template->H);
}

TEST(PaperTrack, FindsTheTemplateWhereItWasLearned) {
  const TrackState start = looking_at(first_window(kBox, kWidth, kHeight));
  const Track seen = paper_track(model(), frame_of(scene()), start, kPaper);
  ASSERT_TRUE(seen.found());
  EXPECT_EQ(seen.miss, Miss::None);
  EXPECT_EQ(seen.window.width, 2 * kBox.width);
  // The same keypoints, described alike: what is left is rounding.
  EXPECT_LT(test::corner_distance(*seen.image_from_template, test::translation(60, 50), 90, 70),
            1e-6);
  EXPECT_GT(int(seen.inliers.size()), int(model().keypoints().at.size()) / 2);
}

TEST(PaperTrack, PartsItsMatchesInThoseThatAgreeAndTheOthers) {
  const TrackState start = looking_at(first_window(kBox, kWidth, kHeight));
  const Track seen = paper_track(model(), frame_of(scene()), start, kPaper);
  EXPECT_EQ(int(seen.inliers.size() + seen.others.size()), seen.matches);
  for (const PixelPair& pair : seen.others) {
    const Pixel there = *seen.image_from_template * pair.in_template;
    EXPECT_GT(distance(there, pair.in_image), 1) << "it would agree";
  }
  TrackOptions wary = kPaper;
  wary.ransac.min_inliers = 10000;  // more than there are: nothing agrees
  const Track refused = paper_track(model(), frame_of(scene()), start, wary);
  EXPECT_TRUE(refused.inliers.empty());
  EXPECT_GT(refused.matches, 0);
  EXPECT_EQ(int(refused.others.size()), refused.matches);
}

TEST(PaperTrack, RecoversKnownViews) {
  for (const test::Motion& motion :
       {test::Motion{0.5, 0, 0, 0}, test::Motion{0.7, 0.3, 0, 0}, test::Motion{1.4, -0.3, 0, 0},
        test::Motion{2, 0, 0, 0}, test::Motion{1, M_PI / 4, 0, 0}, test::Motion{1, M_PI, 0, 0},
        test::Motion{1, 0, 0.6, 0}, test::Motion{1.2, 0.5, 0.6, 1}}) {
    const Homography H = test::moved(motion, kCentre, {99, 79});
    const Track seen = track_view(H, everywhere());
    ASSERT_TRUE(seen.found()) << motion.scale << " " << motion.angle << " " << motion.tilt;
    const double deviation = outline_deviation_px(*seen.image_from_template, seen.inliers,
                                                  model().width(), model().height());
    // Three deviations that the inliers' own noise explains.
    EXPECT_LT(test::corner_distance(*seen.image_from_template, truth(H), 90, 70), 3 * deviation)
        << motion.scale << " " << motion.angle << " " << motion.tilt;
    EXPECT_LT(deviation, 1.5);
  }
}

TEST(PaperTrack, LooksNextAroundTheOutlineItFound) {
  const Homography H = test::moved({0.7, 0, 0, 0}, kCentre, {95, 75});
  const Track seen = track_view(H, everywhere());
  ASSERT_TRUE(seen.found());
  const PixelBox expected =
      window_around(outline(*seen.image_from_template, 90, 70), kWidth, kHeight);
  EXPECT_EQ(seen.next.window.u, expected.u);
  EXPECT_EQ(seen.next.window.v, expected.v);
  EXPECT_EQ(seen.next.window.width, expected.width);
  EXPECT_EQ(seen.next.window.height, expected.height);
}

TEST(PaperTrack, DoublesItsWindowUntilItFindsTheTemplateAgain) {
  const Homography H = test::moved({0.6, 0, 0, 0}, kCentre, {155, 120});
  TrackState state = looking_at({0, 0, 64, 64});  // where it is not
  double area = 64 * 64;
  for (int i = 0; i < 6; ++i) {
    const Track seen = track_view(H, state);
    if (seen.found()) {
      EXPECT_GT(i, 1);
      EXPECT_LT(test::corner_distance(*seen.image_from_template, truth(H), 90, 70), 2);
      return;
    }
    const PixelBox& next = seen.next.window;
    area = std::min(2 * area, double(kWidth) * kHeight);
    EXPECT_NEAR(next.width * next.height, area, 0.05 * area);  // searched on whole pixels
    state = seen.next;
  }
  FAIL() << "not found again";
}

TEST(PaperTrack, LooksOnlyInItsWindow) {
  const Track seen = paper_track(model(), frame_of(scene()), looking_at({0, 0, 70, 64}), kPaper);
  EXPECT_FALSE(seen.found());
  EXPECT_EQ(seen.window.width, 70);
  EXPECT_EQ(seen.window.height, 64);
}

TEST(PaperTrack, IsLostWhereThereIsNothing) {
  test::Random random("nothing");
  cv::Mat black(kHeight, kWidth, CV_8U, cv::Scalar(0));
  cv::Mat white(kHeight, kWidth, CV_8U, cv::Scalar(255));
  cv::Mat noise(kHeight, kWidth, CV_8U, cv::Scalar(128));
  test::add_noise(noise, 60, random);
  const cv::Mat other = test::texture(kWidth, kHeight, random);
  for (const cv::Mat& image : {black, white, noise, other}) {
    const Track seen = paper_track(model(), frame_of(image), everywhere(), kPaper);
    EXPECT_FALSE(seen.found());
    EXPECT_NE(seen.miss, Miss::None);
  }
  EXPECT_EQ(paper_track(model(), frame_of(black), everywhere(), kPaper).miss, Miss::FewKeypoints);
}

TEST(PaperTrack, IsLostInSaturationNotWrong) {
  cv::Mat saturated;
  scene().convertTo(saturated, CV_8U, 30, -2000);  // black and white only
  const Track seen = paper_track(model(), frame_of(saturated), everywhere(), kPaper);
  if (seen.found()) {
    EXPECT_LT(test::corner_distance(*seen.image_from_template, test::translation(60, 50), 90, 70),
              5);
  }
  cv::Mat burnt;
  scene().convertTo(burnt, CV_8U, 1, 240);
  EXPECT_FALSE(paper_track(model(), frame_of(burnt), everywhere(), kPaper).found());
}

TEST(PaperTrack, DoesNotTakeAMirrorImageForTheTemplate) {
  cv::Mat mirrored;
  cv::flip(scene(), mirrored, 1);
  EXPECT_FALSE(paper_track(model(), frame_of(mirrored), everywhere(), kPaper).found());
}

TEST(PaperTrack, WaitsWhereItWasWithoutAnImage) {
  const TrackState state = looking_at({12, 34, 100, 90});
  for (const cv::Mat& image : {cv::Mat(), cv::Mat(kHeight, kWidth, CV_8UC3, cv::Scalar::all(9)),
                               cv::Mat(kHeight, kWidth, CV_32F, cv::Scalar(9))}) {
    const Track seen = paper_track(model(), frame_of(image), state, kPaper);
    EXPECT_FALSE(seen.found());
    EXPECT_EQ(seen.miss, Miss::NoImage);
    EXPECT_EQ(seen.next.window.u, 12);
    EXPECT_EQ(seen.next.window.height, 90);
  }
}

TEST(PaperTrack, GoesOnWhenTheImageChangesItsSize) {
  const TrackState state = looking_at({150, 120, 90, 80});
  const cv::Mat small = scene()(cv::Rect(50, 40, 120, 100)).clone();  // the window lies outside
  const Track seen = paper_track(model(), frame_of(small), state, kPaper);
  EXPECT_EQ(seen.window.width, 120);
  ASSERT_TRUE(seen.found());
  EXPECT_LT(test::corner_distance(*seen.image_from_template, test::translation(10, 10), 90, 70), 1);
  const cv::Mat tiny = scene()(cv::Rect(100, 80, 5, 4)).clone();
  EXPECT_EQ(paper_track(model(), frame_of(tiny), state, kPaper).miss, Miss::FewKeypoints);
}

TEST(PaperTrack, SearchesTheWholeImageForAWindowThatIsNone) {
  for (const PixelBox& window : {PixelBox{kNaN, 0, 10, 10}, PixelBox{}, PixelBox{1e9, 1e9, 5, 5}}) {
    const Track seen = paper_track(model(), frame_of(scene()), looking_at(window), kPaper);
    EXPECT_TRUE(seen.found());
    EXPECT_EQ(seen.window.width, kWidth);
    EXPECT_EQ(seen.window.height, kHeight);
  }
}

TEST(PaperTrack, RejectsAnOutlineThatIsNoView) {
  TrackOptions options = kPaper;
  options.outline.max_area_ratio = 1.2;
  const cv::Mat twice =
      test::view(scene(), test::moved({1.5, 0, 0, 0}, kCentre, {100, 80}), kWidth, kHeight);
  const Track seen = paper_track(model(), frame_of(twice), everywhere(), options);
  EXPECT_EQ(seen.miss, Miss::BadOutline);
  EXPECT_FALSE(seen.found());
  EXPECT_GE(int(seen.inliers.size()), options.ransac.min_inliers);
}

TEST(PaperTrack, DoesNotGuessTheOutlineFromOneCorner) {
  cv::Mat covered(kHeight, kWidth, CV_8U, cv::Scalar(128));
  const cv::Rect corner(50, 40, 46, 40);  // what is left to see
  scene()(corner).copyTo(covered(corner));
  TrackOptions trusting = kPaper;
  trusting.max_outline_deviation_px = 1e6;
  const Track seen = paper_track(model(), frame_of(covered), everywhere(), trusting);
  ASSERT_GE(int(seen.inliers.size()), trusting.ransac.min_inliers);
  EXPECT_EQ(paper_track(model(), frame_of(covered), everywhere(), kPaper).miss, Miss::Undetermined);
}

TEST(PaperTrack, IsAFunctionOfItsArguments) {
  const Homography H = test::moved({0.8, 0.4, 0.4, 1}, kCentre, {103, 83});
  const cv::Mat image = test::view(scene(), H, kWidth, kHeight);
  const Track first = paper_track(model(), frame_of(image), everywhere(), kPaper);
  ASSERT_TRUE(first.found());
  paper_track(model(), frame_of(scene()), everywhere(), kPaper);
  cv::theRNG().next();
  const int threads = cv::getNumThreads();
  cv::setNumThreads(1);
  EXPECT_TRUE(same(first, paper_track(model(), frame_of(image), everywhere(), kPaper)));
  cv::setNumThreads(threads);
  Track there;
  std::thread([&] {
    const Template again(scene(), kBox, kPaper);
    there = paper_track(again, frame_of(image), everywhere(), kPaper);
  }).join();
  EXPECT_TRUE(same(first, there));
}

TEST(PaperTrack, DrawsAnewInEveryFrame) {
  // A tolerance below the noise: how many trials that costs depends on the draws.
  TrackOptions strict = kPaper;
  strict.ransac.max_reprojection_px = 0.3;
  const Homography H = test::moved({0.8, 0.4, 0, 0}, kCentre, {103, 83});
  cv::Mat image = test::view(scene(), H, kWidth, kHeight);
  test::Random random("anew");
  test::add_noise(image, 6, random);
  std::set<int> trials;
  for (std::int64_t index = 0; index < 3; ++index) {
    trials.insert(
        paper_track(model(), frame_of(image, index), looking_at({40, 30, 120, 100}), strict)
            .trials);
  }
  EXPECT_GT(trials.size(), 1U);
}

}  // namespace
}  // namespace kestrel
