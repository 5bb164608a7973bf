#include "kestrel/vision/blur.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "support/random.hpp"
#include "support/rendered_view.hpp"

namespace kestrel {
namespace {

/// One white pixel on black, blurred.
cv::Mat spread(const Blur& motion) {
  cv::Mat dot(61, 61, CV_8UC1, cv::Scalar(0));
  dot.at<uchar>(30, 30) = 255;
  return blurred(dot, {0, 0, 61, 61}, motion);
}

TEST(Blur, MakesALineOfItsLengthAndDirectionOfAPoint) {
  for (const Blur motion : {Blur{7, 0}, {9, M_PI / 6}, {12, 2 * M_PI / 3}}) {
    const cv::Mat seen = spread(motion);
    double sum = 0;
    double u = 0;
    double v = 0;
    double along2 = 0;
    double across2 = 0;
    for (int y = 0; y < 61; ++y) {
      for (int x = 0; x < 61; ++x) {
        const double w = seen.at<uchar>(y, x);
        const double c = std::cos(motion.direction_rad);
        const double s = std::sin(motion.direction_rad);
        sum += w;
        u += w * (x - 30);
        v += w * (y - 30);
        along2 += w * std::pow(c * (x - 30) + s * (y - 30), 2);
        across2 += w * std::pow(c * (y - 30) - s * (x - 30), 2);
      }
    }
    EXPECT_NEAR(sum, 255, 10);      // rounded in each of up to 25 pixels
    EXPECT_NEAR(u / sum, 0, 0.05);  // about where it was
    EXPECT_NEAR(v / sum, 0, 0.05);
    // A uniform line: length^2 / 12, and 1/6 at most for sharing a pixel's weight among two.
    EXPECT_NEAR(along2 / sum, motion.length_px * motion.length_px / 12, 0.4);
    EXPECT_LT(across2 / sum, 0.25);
  }
}

/// A uniform disc of radius R has the variance R^2 / 4 along any line, R^2 = length^2 / 3; that
/// the disc is made of pixels adds 1/12, and rounding to eight bits at its rim takes a few per
/// cent.
TEST(Blur, MakesADiscAsWideAsALineOfItsLengthIsLong) {
  for (const double length : {7.0, 11.25}) {
    const cv::Mat seen = spread({length, 0, BlurShape::Disc});
    double sum = 0;
    double u2 = 0;
    double v2 = 0;
    double uv = 0;
    for (int y = 0; y < 61; ++y) {
      for (int x = 0; x < 61; ++x) {
        const double w = seen.at<uchar>(y, x);
        sum += w;
        u2 += w * (x - 30) * (x - 30);
        v2 += w * (y - 30) * (y - 30);
        uv += w * (x - 30) * (y - 30);
        EXPECT_NEAR(w, seen.at<uchar>(x, y), 1);  // as wide as high
      }
    }
    EXPECT_NEAR(u2 / sum, length * length / 12 + 1.0 / 12, 0.05 * length * length / 12);
    EXPECT_NEAR(v2 / sum, u2 / sum, 0.05);
    EXPECT_NEAR(uv / sum, 0, 0.05);
  }
}

TEST(Blur, SomeDiscIsNearAny) {
  for (const double length : {6.0, 9.0, 14.0, 19.0}) {
    const auto all = blurs(130, 90);
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const Blur& b) {
      return b.shape == BlurShape::Disc && length / b.length_px < 1.25 &&
             b.length_px / length < 1.25;
    })) << length;
  }
}

TEST(Blur, SeesWhatSurroundsTheBox) {
  cv::Mat halves(40, 80, CV_8UC1, cv::Scalar(0));
  halves.colRange(40, 80).setTo(200);
  const cv::Mat left = blurred(halves, {10, 10, 30, 20}, {8, 0});
  ASSERT_EQ(left.cols, 30);
  ASSERT_EQ(left.rows, 20);
  EXPECT_EQ(left.at<uchar>(10, 20), 0);
  // The last column sees 4 px to the right of its centre, 3.5 of them white, of 8.
  EXPECT_NEAR(left.at<uchar>(10, 29), 200 * 3.5 / 8, 2);
  // At the image's edge its last pixels go on.
  EXPECT_EQ(blurred(halves, {60, 0, 20, 40}, {8, 0}).at<uchar>(20, 19), 200);
}

TEST(Blur, SomeLineIsNearAny) {
  const auto motions = blurs(130, 90);
  for (int i = 0; i < 60; ++i) {
    const double angle = i * M_PI / 60;
    for (const double length : {6.0, 9.0, 14.0, 19.0}) {
      bool is_near = false;
      for (const Blur& m : motions) {
        if (m.shape != BlurShape::Line) continue;
        const double across = std::abs(std::sin(m.direction_rad - angle));
        const double ratio = length / m.length_px;
        is_near = is_near || (across < 0.26 && ratio < 1.25 && ratio > 1 / 1.25);
      }
      EXPECT_TRUE(is_near) << angle << " " << length;
    }
  }
}

TEST(Blur, NoneLeavesLessThanAQuarterOfTheTemplate) {
  EXPECT_EQ(blurs(60, 46).size(), 21u);  // 5, 7.5, 11.25 px
  EXPECT_EQ(blurs(400, 300).size(), 28u);
  EXPECT_TRUE(blurs(60, 16).empty());
}

TEST(Blur, BlocksAreThoseOfTheBlurredPictures) {
  test::Random random("motion blur");
  const cv::Mat gray = test::texture(160, 120, random);
  const PixelBox box{40, 30, 80, 60};
  const auto all = blurred_blocks(gray, box, template_blocks(gray(cv::Rect(40, 30, 80, 60)), {}));
  const auto motions = blurs(80, 60);
  ASSERT_EQ(all.size(), motions.size());
  for (std::size_t k = 0; k < all.size(); k += 5) {
    const cv::Mat picture = blurred(gray, box, motions[k]);
    const BlockLevel& level = all[k].levels.front();
    ASSERT_FALSE(level.blocks.empty());
    EXPECT_LE(int(level.blocks.size()), BlockOptions{}.max_blocks / 2);
    const TemplateBlock& b = level.blocks.front();
    const cv::Mat pixels = picture(cv::Rect(int(b.u), int(b.v), 8, 8));
    for (int i = 0; i < 64; ++i) {
      EXPECT_NEAR(level.textures[std::size_t(i)],
                  pixels.at<uchar>(i / 8, i % 8) - cv::mean(pixels)[0], 1e-4);
    }
  }
}

}  // namespace
}  // namespace kestrel
