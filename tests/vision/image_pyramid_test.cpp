#include "kestrel/vision/image_pyramid.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "support/random.hpp"

namespace kestrel {
namespace {

cv::Mat noise(int width, int height, const char* name) {
  test::Random random(name);
  cv::Mat image(height, width, CV_8UC1);
  for (auto p = image.begin<std::uint8_t>(); p != image.end<std::uint8_t>(); ++p) {
    *p = std::uint8_t(random.uniform(0, 256));
  }
  return image;
}

int pixel(const PyramidLevel& level, int x, int y) { return level.pixels[y * level.stride + x]; }

TEST(ImagePyramid, PixelIsTheRoundedMeanOfTheFourItCovers) {
  const cv::Mat image = noise(53, 37, "pyramid mean");
  ImagePyramid pyramid;
  pyramid.look(image, {0, 0, 53, 37}, 4, Simd::Auto);
  ASSERT_EQ(pyramid.levels(), 4);
  for (int k = 1; k < 4; ++k) {
    const PyramidLevel& below = pyramid.level(k - 1);
    const PyramidLevel& level = pyramid.level(k);
    EXPECT_EQ(level.right, 53 >> k);
    EXPECT_EQ(level.bottom, 37 >> k);
    for (int y = 0; y < level.bottom; ++y) {
      for (int x = 0; x < level.right; ++x) {
        const int sum = pixel(below, 2 * x, 2 * y) + pixel(below, 2 * x + 1, 2 * y) +
                        pixel(below, 2 * x, 2 * y + 1) + pixel(below, 2 * x + 1, 2 * y + 1);
        ASSERT_EQ(pixel(level, x, y), (sum + 2) / 4) << k << ": " << x << "," << y;
      }
    }
  }
}

TEST(ImagePyramid, IsTheSameWithAndWithoutAvx2) {
  const cv::Mat image = noise(131, 77, "pyramid simd");
  ImagePyramid fast;
  ImagePyramid plain;
  fast.look(image, {0, 0, 131, 77}, 4, Simd::Auto);
  plain.look(image, {0, 0, 131, 77}, 4, Simd::Baseline);
  for (int k = 1; k < 4; ++k) {
    for (int y = 0; y < fast.level(k).bottom; ++y) {
      for (int x = 0; x < fast.level(k).right; ++x) {
        ASSERT_EQ(pixel(fast.level(k), x, y), pixel(plain.level(k), x, y));
      }
    }
  }
}

TEST(ImagePyramid, IsMadeWhereItIsLookedAtInPlacesOfTheWholeFrame) {
  const cv::Mat image = noise(160, 120, "pyramid window");
  ImagePyramid all;
  all.look(image, {0, 0, 160, 120}, 4, Simd::Auto);
  ImagePyramid part;
  part.look(image, {43, 21, 50, 40}, 4, Simd::Auto);
  for (int k = 0; k < 4; ++k) {
    const PyramidLevel& level = part.level(k);
    EXPECT_LE(level.left << k, 43);
    EXPECT_LE(level.top << k, 21);
    EXPECT_GE(level.right << k, 93);
    EXPECT_GE(level.bottom << k, 61);
    for (int y = level.top; y < level.bottom; ++y) {
      for (int x = level.left; x < level.right; ++x) {
        ASSERT_EQ(pixel(level, x, y), pixel(all.level(k), x, y));
      }
    }
  }
}

TEST(ImagePyramid, CentresOfPixelsLieBetweenThoseTheyCover) {
  const Eigen::Vector3d first = level0_from_level(3) * Eigen::Vector3d(0, 0, 1);
  EXPECT_DOUBLE_EQ(first.x(), 3.5);  // the mean of 0 ... 7
  EXPECT_DOUBLE_EQ(first.y(), 3.5);
  const Eigen::Vector3d next = level0_from_level(3) * Eigen::Vector3d(1, 2, 1);
  EXPECT_DOUBLE_EQ(next.x(), 11.5);
  EXPECT_DOUBLE_EQ(next.y(), 19.5);
}

TEST(ImagePyramid, HoldsNothingForAWindowBesideTheFrame) {
  const cv::Mat image = noise(64, 48, "pyramid beside");
  ImagePyramid pyramid;
  pyramid.look(image, {200, 10, 20, 20}, 3, Simd::Auto);
  for (int k = 0; k < 3; ++k) {
    EXPECT_GE(pyramid.level(k).left, pyramid.level(k).right);
  }
}

TEST(ImagePyramid, RefusesWhatIsNotEightBitGrey) {
  ImagePyramid pyramid;
  EXPECT_THROW(pyramid.look(cv::Mat(), {0, 0, 1, 1}, 2, Simd::Auto), std::invalid_argument);
  EXPECT_THROW(pyramid.look(cv::Mat(8, 8, CV_32F), {0, 0, 8, 8}, 2, Simd::Auto),
               std::invalid_argument);
}

}  // namespace
}  // namespace kestrel
