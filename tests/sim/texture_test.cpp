#include "kestrel/sim/texture.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace kestrel {
namespace {

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0;
}

/// Correlation coefficient of a picture with itself, moved by (dx, dy) px.
double self_likeness(const cv::Mat& picture, int dx, int dy) {
  const int w = picture.cols - dx;
  const int h = picture.rows - dy;
  cv::Mat score;
  cv::matchTemplate(picture(cv::Rect(0, 0, w, h)), picture(cv::Rect(dx, dy, w, h)), score,
                    cv::TM_CCOEFF_NORMED);
  return score.at<float>(0);
}

TEST(Texture, SameSeedSameBytes) {
  EXPECT_TRUE(same(poster(160, 120, 3), poster(160, 120, 3)));
  EXPECT_TRUE(same(facade(240, 160, 20, 3), facade(240, 160, 20, 3)));
  EXPECT_TRUE(same(ground(120, 90, 3), ground(120, 90, 3)));
  EXPECT_FALSE(same(poster(160, 120, 3), poster(160, 120, 4)));
  EXPECT_FALSE(same(facade(240, 160, 20, 3), facade(240, 160, 20, 4)));
  EXPECT_FALSE(same(ground(120, 90, 3), ground(120, 90, 4)));
}

TEST(Texture, IsGreyAndOfTheSizeAskedFor) {
  for (const cv::Mat& m : {poster(161, 97, 1), facade(161, 97, 20, 1), ground(161, 97, 1)}) {
    EXPECT_EQ(m.size(), cv::Size(161, 97));
    EXPECT_EQ(m.type(), CV_8UC1);
  }
}

TEST(Texture, PosterHasContrastEverywhereAtEveryScale) {
  cv::Mat level = poster(512, 384, 1);
  for (int octave = 0; octave < 4; ++octave) {
    int flat = 0;
    int blocks = 0;
    for (int y = 0; y + 16 <= level.rows; y += 16) {
      for (int x = 0; x + 16 <= level.cols; x += 16, ++blocks) {
        cv::Scalar mean;
        cv::Scalar deviation;
        cv::meanStdDev(level(cv::Rect(x, y, 16, 16)), mean, deviation);
        flat += deviation[0] < 8;  // four times the noise of a poor camera
      }
    }
    EXPECT_LE(flat, blocks / 10) << "octave " << octave;
    cv::pyrDown(level, level);
  }
}

TEST(Texture, PosterIsNowhereLikeItselfButTheFacadeIs) {
  const cv::Mat unique = poster(320, 240, 1);
  for (int dy = 0; dy < 160; dy += 20) {
    for (int dx = 0; dx < 240; dx += 20) {
      if (dx + dy < 40) continue;
      EXPECT_LT(self_likeness(unique, dx, dy), 0.45) << dx << "," << dy;
    }
  }
  const cv::Mat wall = facade(480, 320, 20, 1);
  EXPECT_GT(self_likeness(wall, 60, 0), 0.6);  // one window on: 3.0 m
  EXPECT_GT(self_likeness(wall, 0, 64), 0.6);  // 3.2 m
}

TEST(Texture, RefusesWhatHasNoRoomOrNoScale) {
  EXPECT_THROW(poster(15, 100, 1), std::invalid_argument);
  EXPECT_THROW(facade(100, 0, 20, 1), std::invalid_argument);
  EXPECT_THROW(facade(100, 100, 0, 1), std::invalid_argument);
  EXPECT_THROW(ground(-1, 100, 1), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel
