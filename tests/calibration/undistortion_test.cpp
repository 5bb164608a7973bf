#include "kestrel/calibration/undistortion.hpp"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "board_views.hpp"

namespace kestrel {
namespace {

/// A picture of 640 x 480 px that is 200 where the ray of a pixel has |x| < 0.1 (a straight upright
/// bar in front of the camera), 50 elsewhere, 0 where there is no ray.
cv::Mat bar(const Camera& camera, double x) {
  cv::Mat picture(480, 640, CV_8UC1);
  for (int v = 0; v < picture.rows; ++v) {
    for (int u = 0; u < picture.cols; ++u) {
      const ImagePoint p = camera.to_image_point({double(u), double(v)});
      picture.at<std::uint8_t>(v, u) = std::abs(p.x - x) < 0.1 ? 200 : 50;
    }
  }
  return picture;
}

/// Column of the first pixel above 125 in a row; -1 for none.
int left_edge(const cv::Mat& picture, int row) {
  for (int u = 0; u < picture.cols; ++u)
    if (picture.at<std::uint8_t>(row, u) > 125) return u;
  return -1;
}

TEST(Undistorted, StraightLinesAreStraight) {
  for (const Camera& camera : {test::wide_angle(), test::fisheye()}) {
    const cv::Mat before = bar(camera, 0.4);
    const cv::Mat after = undistorted(before, camera);
    ASSERT_EQ(after.size(), before.size());
    EXPECT_GT(std::abs(left_edge(before, 240) - left_edge(before, 10)), 5);
    for (const int row : {120, 180, 300, 360})
      EXPECT_NEAR(left_edge(after, row), left_edge(after, 240), 1.01) << row;
  }
}

TEST(Undistorted, LeavesAPinholesPictureAsItIs) {
  const cv::Mat before = bar(test::straight(), 0.1);
  const cv::Mat after = undistorted(before, test::straight());
  cv::Mat difference;
  cv::absdiff(before, after, difference);
  EXPECT_LE(cv::mean(difference)[0], 0.5);  // rounding of coordinates at the edges of the bar
}

TEST(Undistorted, RefusesAnotherSize) {
  EXPECT_THROW(undistorted(cv::Mat(100, 100, CV_8UC1), test::straight()), std::invalid_argument);
  EXPECT_THROW(undistorted(cv::Mat(), test::straight()), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel
