// What TargetSearch finds by structures smaller than the usual ones.
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "kestrel/vision/detector.hpp"
#include "kestrel/vision/target_search.hpp"

#include "support/planted_target.hpp"

namespace kestrel {
namespace {

const PixelBox kEverywhere{0, 0, test::kGroundWidth, test::kGroundHeight};

/// A texture of grains so fine that at half its size none is left of the usual structures.
cv::Mat grains() {
  test::Random random("grains");
  cv::Mat image(test::kGroundHeight, test::kGroundWidth, CV_8UC1, cv::Scalar(128));
  test::add_noise(image, 60, random);
  cv::GaussianBlur(image, image, {}, 1.3);
  cv::normalize(image, image, 0, 255, cv::NORM_MINMAX);
  return image;
}

/// Learned on its ground, lost, and seen again turned and at half its size.
class FineGrain : public testing::Test {
 protected:
  FineGrain() {
    const Homography there = test::moved({0.5, 0.7, 0, 0}, {200, 150}, {200, 150});
    cv::Mat fine;
    cv::GaussianBlur(grains(), fine, {}, 0.8);  // what a pixel twice as large takes together
    half_ = test::frame_of(test::view(fine, there, test::kGroundWidth, test::kGroundHeight), 0);
    truth_ = test::product(there, test::learned_place());
  }

  const Template learned_{grains(), test::kLearnedAt, {}};
  TargetSearch search_{learned_, {}};
  Frame half_;
  Homography truth_;
};

TEST_F(FineGrain, IsFoundByASecondLook) {
  const Sighting seen = search_.detect(half_, kEverywhere, {});
  ASSERT_TRUE(seen.is_accepted()) << name(seen.miss);
  EXPECT_LT(test::error_px(seen.at->image_from_template, truth_), 0.5);
}

TEST_F(FineGrain, IsLookedForAgainOnlyWhereItMayBeSmall) {
  const Expectation large{test::placed_at({200, 150}, {1.2, 0.7, 0, 0}), 30};
  EXPECT_FALSE(search_.detect(half_, kEverywhere, large).is_accepted());
  EXPECT_TRUE(search_.detect(half_, kEverywhere, Expectation{truth_, 30}).is_accepted());
}

/// Two targets, one of them out of focus: small structures are found on the sharp one only, and
/// would decide what cannot be decided.
TEST(SecondLook, IsNotAskedWhichOfTwoItIs) {
  const Template learned(test::planted(test::learned_place()), test::kLearnedAt, {});
  cv::Mat image = test::planted(test::placed_at({85, 100}));
  cv::Mat other = test::planted(test::placed_at({300.4, 195.3}));
  cv::GaussianBlur(other, other, {}, 1.2);
  const cv::Rect right(200, 0, 200, test::kGroundHeight);
  other(right).copyTo(image(right));
  Detector detector(learned, {});
  ASSERT_EQ(detector.detect(image, kEverywhere).hypotheses.size(), 2U);
  ASSERT_EQ(detector.detect(image, kEverywhere, Structures::Small).hypotheses.size(), 1U);
  TargetSearch search(learned, {});
  EXPECT_EQ(search.detect(test::frame_of(image, 0), kEverywhere, {}).miss, Miss::Ambiguous);
}

/// What is said of a frame without the target is what the first look saw.
TEST(SecondLook, LeavesTheWordsOfTheFirst) {
  const Template learned(test::planted(test::learned_place()), test::kLearnedAt, {});
  TargetSearch search(learned, {});
  const Sighting none = search.detect(test::frame_of(test::ground(), 0), kEverywhere, {});
  EXPECT_FALSE(none.is_accepted());
  EXPECT_EQ(none.keypoints, Detector(learned, {}).detect(test::ground(), kEverywhere).keypoints);
}

}  // namespace
}  // namespace kestrel
