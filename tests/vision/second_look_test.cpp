// What TargetSearch finds by structures smaller than the usual ones.
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

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

}  // namespace
}  // namespace kestrel
