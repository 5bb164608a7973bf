#include "kestrel/vision/target_search.hpp"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "kestrel/vision/blur.hpp"

#include "support/planted_target.hpp"

namespace kestrel {
namespace {

using test::error_px;
using test::placed_at;
using test::planted;

const PixelBox kEverywhere{0, 0, test::kGroundWidth, test::kGroundHeight};

const Template& model() {
  static const Template learned(planted(test::learned_place()), test::kLearnedAt, {});
  return learned;
}

TargetSearch& search() {
  static TargetSearch shared(model(), {});
  return shared;
}

Frame frame_of(const cv::Mat& gray) { return test::frame_of(gray, 0); }

/// The target's place, so many px off.
Homography shifted(const Homography& H, double du, double dv) {
  return test::product(test::translation(du, dv), H);
}

/// Two targets of the same picture.
cv::Mat twins(const Homography& one, const Homography& other) {
  cv::Mat image = test::ground();
  test::plant(image, one);
  test::plant(image, other);
  cv::addWeighted(image, 1, test::noise_of_ground(), 1, -128, image);
  return image;
}

TEST(TargetSearch, FollowsFromWhicheverPlaceShowsMore) {
  const Homography truth = placed_at({210, 150}, {1.05, 0.1, 0.2, 0});
  const Frame frame = frame_of(planted(truth));
  const Homography off = shifted(truth, 70, 0);
  const Homography near = shifted(truth, 3, -2);
  for (const auto& [last, ahead] : {std::pair(near, off), std::pair(off, near)}) {
    const Sighting seen = search().follow(frame, last, Expectation{ahead, 2});
    ASSERT_TRUE(seen.is_accepted());
    EXPECT_EQ(seen.stage, TrackStage::Aligned);
    EXPECT_LT(error_px(seen.at->image_from_template, truth), 0.2);
    EXPECT_EQ(seen.keypoints, 0);
    EXPECT_LT(seen.window.width, test::kGroundWidth);  // only what it looked at
  }
}

TEST(TargetSearch, SearchesTheNeighbourhoodWhenInDoubt) {
  const Homography truth = placed_at({210, 150});
  const Frame frame = frame_of(planted(truth));
  for (int k = 0; k < 8; ++k) {
    const double a = k * M_PI / 4;
    const Homography off = shifted(truth, 38 * std::cos(a), 38 * std::sin(a));
    const Sighting seen = search().follow(frame, off, {});
    ASSERT_TRUE(seen.is_accepted()) << k;
    EXPECT_LT(error_px(seen.at->image_from_template, truth), 0.2) << k;
  }
}

TEST(TargetSearch, FollowsNothingThatIsNotThere) {
  const Homography H = placed_at({210, 150});
  const Sighting gone = search().follow(frame_of(test::ground()), H, {});
  EXPECT_FALSE(gone.is_accepted());
  EXPECT_EQ(gone.miss, Miss::NotAlike);
  const Homography outside = placed_at({2000, -900});
  EXPECT_FALSE(search().follow(frame_of(planted(H)), outside, {}).is_accepted());
}

/// All its pixels agree, and no camera shows a plane from behind.
TEST(TargetSearch, RefusesWhatIsMirrored) {
  Homography mirrored = placed_at({210, 150});
  mirrored.H.col(2) += mirrored.H.col(0) * (test::kTargetWidth - 1);
  mirrored.H.col(0) *= -1;
  EXPECT_FALSE(search().follow(frame_of(planted(mirrored)), mirrored, {}).is_accepted());
}

TEST(TargetSearch, ACoveredTargetIsAWeakSight) {
  const Homography truth = placed_at({210, 150});
  const Sighting whole = search().follow(frame_of(planted(truth)), truth, {});
  ASSERT_TRUE(whole.is_accepted());
  EXPECT_FALSE(search().is_weak(*whole.at));
  cv::Mat covered = planted(truth);
  covered(cv::Rect(130, 80, 88, 140)).setTo(128);  // 55 % of it
  const Sighting part = search().follow(frame_of(covered), truth, {});
  ASSERT_TRUE(part.is_accepted());
  EXPECT_TRUE(search().is_weak(*part.at));
  EXPECT_LT(error_px(part.at->image_from_template, truth), 0.5);
}

TEST(TargetSearch, FollowsWhatMotionBlurs) {
  // 22 px long, between the directions that were learned, in a picture that is turned and larger:
  // aligned with the sharp template alone the corners are 5 px off.
  const Homography truth = placed_at({205, 148}, {1.2, 0.4, 0.2, 1});
  const PixelBox all{0, 0, test::kGroundWidth, test::kGroundHeight};
  const Blur motion{22, 2.6};
  const Homography off = shifted(truth, 4, -3);
  const Frame frame = frame_of(blurred(planted(truth), all, motion));
  const Sighting seen = search().follow(frame, off, Expectation{off, 3});
  ASSERT_TRUE(seen.is_accepted());
  EXPECT_FALSE(search().is_weak(*seen.at));
  EXPECT_LT(error_px(seen.at->image_from_template, truth), motion.length_px / 10);
}

/// The target smeared over so many px, with its upper rows covered.
Frame smeared(const Homography& truth, double length_px, int covered_rows) {
  cv::Mat image = blurred(planted(truth), kEverywhere, Blur{length_px, 0.5});
  const int top = int(test::kLearnedAt.v);
  image(cv::Rect(0, top, test::kGroundWidth, covered_rows)).setTo(128);
  return frame_of(image);
}

/// What is smooth looks like some blur of the template: one that was lost, and may be anywhere, is
/// not taken for its blur. Over 30 px nothing of it is left to be seen sharp.
TEST(TargetSearch, TakesBlurredViewsOnlyWhereTheTargetIsExpected) {
  const Homography truth = test::learned_place();
  const Homography off = shifted(truth, 2, -2);
  const Frame frame = smeared(truth, 30, 0);
  EXPECT_TRUE(search().follow(frame, off, Expectation{off, 3}).is_accepted());
  EXPECT_FALSE(search().follow(frame, off, {}).is_accepted());
}

/// Of a sharp view half is enough; of a blurred one two thirds are asked. 22 px leave nothing sharp
/// of 60 %, and a tenth is room for blocks that are covered in part.
TEST(TargetSearch, TakesBlurredViewsThatShowTwoThirdsOnly) {
  const Homography truth = test::learned_place();
  const auto is_found = [&](double length_px, double covered) {
    const Frame frame = smeared(truth, length_px, int(covered * test::kTargetHeight));
    return search().follow(frame, truth, Expectation{truth, 3}).is_accepted();
  };
  EXPECT_TRUE(is_found(22, 0.23));
  EXPECT_FALSE(is_found(22, 0.43));
  EXPECT_TRUE(is_found(1, 0.43));
}

/// Print on a box: few edges, and strong ones.
cv::Mat print() {
  test::Random random("print");
  cv::Mat image(200, 260, CV_8UC1, cv::Scalar(90));
  for (int i = 0; i < 14; ++i) {
    const cv::Point from(random.integer(20, 190), random.integer(20, 140));
    const cv::Size size(random.integer(12, 60), random.integer(10, 40));
    cv::rectangle(image, cv::Rect(from, size), cv::Scalar(random.integer(20, 235)), cv::FILLED);
  }
  return image;
}

/// A bell as wide as the learned discs are not: between two of them. The sharp template alone sees
/// of an edge near a block's side only a part, wherever it is aligned from.
TEST(TargetSearch, HoldsWhatIsOutOfFocusAgainstItsLike) {
  const cv::Mat scene = print();
  const PixelBox box{30, 30, 160, 120};
  const Template learned(scene, box, {});
  TargetSearch follower(learned, {});
  cv::Mat image;
  cv::GaussianBlur(scene, image, {}, 2.6);
  const Homography truth = test::translation(30, 30);
  const Homography start = shifted(truth, 2, -1);
  Aligner sharp(learned.blocks(), {});
  ImagePyramid pyramid;
  pyramid.look(image, {0, 0, 260, 200}, sharp.levels(), Simd::Auto);
  const auto alone = sharp.align(pyramid, start);
  const Sighting seen = follower.follow(frame_of(image), start, {});
  ASSERT_TRUE(alone && seen.is_accepted());
  const auto off_px = [&](const Homography& H) {
    double sum = 0;
    const auto at = outline(H, 160, 120);
    const auto to = outline(truth, 160, 120);
    for (std::size_t i = 0; i < 4; ++i) sum += distance(at[i], to[i]) / 4;
    return sum;
  };
  EXPECT_EQ(seen.stage, TrackStage::Aligned);
  EXPECT_LT(3 * off_px(seen.at->image_from_template), off_px(alone->image_from_template));
  EXPECT_LT(seen.at->corner_covariance.trace(), alone->corner_covariance.trace() / 4);
}

/// A texture twice side by side, on the ground.
class RepeatedTarget : public testing::Test {
 protected:
  static constexpr int kPeriod = 80;

  static cv::Mat picture() {
    test::Random random("a period");
    const cv::Mat period = test::texture(kPeriod, test::kTargetHeight, random);
    cv::Mat all;
    cv::repeat(period, 1, test::kTargetWidth / kPeriod, all);
    return all;
  }
  static cv::Mat scene() {
    cv::Mat image = test::ground();
    const PixelBox& at = test::kLearnedAt;
    picture().copyTo(image(cv::Rect(int(at.u), int(at.v), int(at.width), int(at.height))));
    return image;
  }
};

TEST_F(RepeatedTarget, IsHeldAgainstThePlacesWhereItIsLikeItself) {
  // Half of it shows when its one half is taken for the other: not as much as where it is.
  const Template repeated(scene(), test::kLearnedAt, {});
  TargetSearch with(repeated, {});
  const Homography truth = test::learned_place();
  const Homography beside = shifted(truth, kPeriod, 0);
  const Sighting seen = with.follow(frame_of(scene()), beside, {});
  ASSERT_TRUE(seen.is_accepted());
  EXPECT_LT(error_px(seen.at->image_from_template, truth), 0.2);
}

TEST_F(RepeatedTarget, HalfCoveredIsToldByTheMotion) {
  // As much of it shows as where its one half is taken for the other: nothing but the motion rules
  // that out, where its uncertainty is far below the period.
  const Template repeated(scene(), test::kLearnedAt, {});
  TargetSearch with(repeated, {});
  const Homography truth = test::learned_place();
  cv::Mat covered = scene();
  const PixelBox& at = test::kLearnedAt;
  covered(cv::Rect(int(at.u), int(at.v), int(at.width), int(at.height) * 58 / 100)).setTo(128);
  EXPECT_FALSE(with.follow(frame_of(covered), truth, {}).is_accepted());
  const double vague_px = kPeriod / 3.0;  // three of these reach the period
  EXPECT_FALSE(
      with.follow(frame_of(covered), truth, Expectation{truth, 1.1 * vague_px}).is_accepted());
  // A motion that leads to none of the places tells nothing of them.
  EXPECT_FALSE(
      with.follow(frame_of(covered), truth, Expectation{shifted(truth, 0, 40), 2}).is_accepted());
  const Sighting seen = with.follow(frame_of(covered), truth, Expectation{shifted(truth, 2, 2), 2});
  ASSERT_TRUE(seen.is_accepted());
  EXPECT_LT(error_px(seen.at->image_from_template, truth), 0.5);
}

TEST_F(RepeatedTarget, IsNotToldByAMotionThatLeadsBeside) {
  // The place it shows more of is taken, wherever it was expected.
  const Template repeated(scene(), test::kLearnedAt, {});
  TargetSearch with(repeated, {});
  const Homography truth = test::learned_place();
  const Homography beside = shifted(truth, kPeriod, 0);
  const Sighting seen = with.follow(frame_of(scene()), beside, Expectation{beside, 2});
  ASSERT_TRUE(seen.is_accepted());
  EXPECT_LT(error_px(seen.at->image_from_template, truth), 0.2);
}

TEST_F(RepeatedTarget, HalfCoveredIsNotToldByKeypoints) {
  // What is left of it is as like one period as the other.
  const Template repeated(scene(), test::kLearnedAt, {});
  TargetSearch with(repeated, {});
  cv::Mat covered = scene();
  const PixelBox& at = test::kLearnedAt;
  const int width = int(at.width) * 47 / 100;
  covered(cv::Rect(int(at.u + at.width) - width, int(at.v), width, int(at.height))).setTo(128);
  EXPECT_EQ(with.detect(frame_of(covered), kEverywhere, {}).miss, Miss::Ambiguous);
}

TEST_F(RepeatedTarget, IsNotComparedWithItsBlurs) {
  // Smeared along its periods, 30 of 80 px, a view of it would be some 5 px off.
  const Template repeated(scene(), test::kLearnedAt, {});
  TargetSearch with(repeated, {});
  const Homography truth = test::learned_place();
  const Frame frame = frame_of(blurred(scene(), kEverywhere, Blur{30, 0}));
  EXPECT_FALSE(with.follow(frame, truth, Expectation{truth, 3}).is_accepted());
}

TEST(TargetSearch, DetectsAndRefinesOnThePixels) {
  const Homography truth = placed_at({230, 160}, {0.8, 1, 0.5, 0});
  const Sighting seen = search().detect(frame_of(planted(truth)), kEverywhere, {});
  ASSERT_TRUE(seen.is_accepted());
  EXPECT_EQ(seen.stage, TrackStage::Detected);
  EXPECT_LT(error_px(seen.at->image_from_template, truth), 0.2);
  EXPECT_GT(seen.keypoints, seen.matches);
  EXPECT_GE(int(seen.inliers.size()), TrackOptions{}.detect.fit.min_inliers);
}

TEST(TargetSearch, PartsItsMatchesInThoseThatLedThereAndTheOthers) {
  const Homography truth = placed_at({210, 150}, {1.05, 0.1, 0.2, 0});
  const Sighting seen = search().detect(frame_of(planted(truth)), kEverywhere, {});
  ASSERT_TRUE(seen.is_accepted());
  EXPECT_FALSE(seen.inliers.empty());
  EXPECT_EQ(int(seen.inliers.size() + seen.others.size()), seen.matches);
  for (const PixelPair& pair : seen.inliers) {
    EXPECT_LT(distance(truth * pair.in_template, pair.in_image), 5) << "a keypoint is that good";
  }
  const Sighting strange = search().detect(frame_of(test::ground()), kEverywhere, {});
  EXPECT_TRUE(strange.inliers.empty());
  EXPECT_EQ(int(strange.others.size()), strange.matches);
}

TEST(TargetSearch, SaysWhyItDetectsNothing) {
  const cv::Mat flat(test::kGroundHeight, test::kGroundWidth, CV_8UC1, cv::Scalar(90));
  EXPECT_EQ(search().detect(frame_of(flat), kEverywhere, {}).miss, Miss::FewKeypoints);
  const Sighting strange = search().detect(frame_of(test::ground()), kEverywhere, {});
  EXPECT_FALSE(strange.is_accepted());
  EXPECT_TRUE(strange.inliers.empty());
}

class TwoEqualTargets : public testing::Test {
 protected:
  const Homography left_ = placed_at({85, 100});
  const Homography right_ = placed_at({300.4, 195.3});
  const Frame frame_ = frame_of(twins(left_, right_));

  Sighting seen(const Homography& where, double deviation_px) const {
    return search().detect(frame_, kEverywhere, Expectation{where, deviation_px});
  }
};

TEST_F(TwoEqualTargets, AreAmbiguousWhenNothingIsExpected) {
  const Sighting unknown = search().detect(frame_, kEverywhere, {});
  EXPECT_EQ(unknown.miss, Miss::Ambiguous);
  EXPECT_TRUE(unknown.inliers.empty());
}

TEST_F(TwoEqualTargets, AreToldApartByWhatIsExpected) {
  for (const Homography& one : {left_, right_}) {
    const Sighting told = seen(shifted(one, 8, 5), 5);
    ASSERT_TRUE(told.is_accepted()) << name(told.miss);
    EXPECT_LT(error_px(told.at->image_from_template, one), 0.2);
    // The pairs reported are those of the place reported.
    ASSERT_FALSE(told.inliers.empty());
    for (const PixelPair& pair : told.inliers) {
      EXPECT_LT(distance(one * pair.in_template, pair.in_image), 5);
    }
  }
}

TEST_F(TwoEqualTargets, AreAmbiguousWhenNeitherIsWhereItIsExpected) {
  // 40 px off with 5 px deviation, on either side: whichever of the two shows more.
  EXPECT_EQ(seen(shifted(left_, 0, 40), 5).miss, Miss::Ambiguous);
  EXPECT_EQ(seen(shifted(right_, 0, -40), 5).miss, Miss::Ambiguous);
}

TEST(TargetSearch, OneTargetIsFoundWhereverItIsExpected) {
  const Homography truth = placed_at({280, 190});
  const Expectation elsewhere{placed_at({100, 90}), 3};
  const Sighting seen = search().detect(frame_of(planted(truth)), kEverywhere, elsewhere);
  ASSERT_TRUE(seen.is_accepted());
  EXPECT_LT(error_px(seen.at->image_from_template, truth), 0.2);
}

}  // namespace
}  // namespace kestrel
