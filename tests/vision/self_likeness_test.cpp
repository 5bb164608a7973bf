#include "kestrel/vision/self_likeness.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "support/random.hpp"
#include "support/rendered_view.hpp"

namespace kestrel {
namespace {

double likeness(const cv::Mat& picture) {
  return self_likeness(picture, template_blocks(picture, {}), {}).share;
}

TEST(SelfLikeness, OfATextureWithoutRepetitionIsChance) {
  test::Random random("no repetition");
  // A part of it that is distorted enough: far below what a chessboard or a repeated part has.
  EXPECT_LT(likeness(test::texture(160, 120, random)), 0.4);
}

TEST(SelfLikeness, OfAChessboardIsNearlyAll) {
  cv::Mat board(160, 160, CV_8UC1);
  for (int v = 0; v < 160; ++v) {
    for (int u = 0; u < 160; ++u) board.at<uchar>(v, u) = (u / 20 + v / 20) % 2 == 0 ? 30 : 220;
  }
  EXPECT_GT(likeness(board), 0.6);  // two squares along: a quarter comes to lie outside
}

TEST(SelfLikeness, OfARepeatedPartIsItsShare) {
  // A texture whose right half repeats its left one.
  test::Random random("repetition");
  cv::Mat picture = test::texture(160, 120, random);
  picture(cv::Rect(0, 0, 80, 120)).copyTo(picture(cv::Rect(80, 0, 80, 120)));
  // Shifted by half, all that is visible is alike: half of all, less what the seam spoils.
  EXPECT_NEAR(likeness(picture), 0.5, 0.1);
}

TEST(SelfLikeness, RaisesTheBar) {
  AgreementOptions options;
  EXPECT_EQ(beyond_self_likeness(options, 0).min_alike_share, options.min_alike_share);
  EXPECT_DOUBLE_EQ(beyond_self_likeness(options, 0.8).min_alike_share, 0.65);
  EXPECT_DOUBLE_EQ(sure_share(0.8), 0.9);
}

}  // namespace
}  // namespace kestrel
