#include "kestrel/sim/outside_view.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "kestrel/sim/world.hpp"

namespace kestrel {
namespace {

using Eigen::Vector3d;

const Vector3d kStart(-9, 1.5, 1);
const Vector3d kGoal(-5, 0, 0);

Scene bare() {
  Scene scene;
  scene.background_grey = 200;
  return scene;
}

Transform<frame::World, frame::Body> at(const Vector3d& position) {
  return {Eigen::Matrix3d::Identity(), position};
}

/// Where pixels differ from the empty picture.
cv::Rect changed(const cv::Mat& picture) {
  cv::Rect all;
  for (int v = 0; v < picture.rows; ++v) {
    for (int u = 0; u < picture.cols; ++u) {
      if (picture.at<cv::Vec3b>(v, u) != cv::Vec3b(200, 200, 200)) all |= cv::Rect(u, v, 1, 1);
    }
  }
  return all;
}

TEST(OutsideView, HasStartAndGoalInView) {
  const cv::Rect whole(0, 0, 320, 240);
  for (const Vector3d& position : {kStart, kGoal}) {
    OutsideView view(bare(), kStart, kGoal, whole.size());
    const cv::Mat picture = view.draw(at(position), forward_mount(), position, 0);
    EXPECT_EQ(picture.type(), CV_8UC3);
    const cv::Rect drawn = changed(picture);
    EXPECT_GT(drawn.area(), 400);
    EXPECT_EQ(drawn & cv::Rect(1, 1, 318, 238), drawn);  // nothing runs out of the picture
  }
}

TEST(OutsideView, ShowsTheWayItCame) {
  OutsideView view(bare(), kStart, kGoal, {320, 240});
  const cv::Rect first = changed(view.draw(at(kStart), forward_mount(), kStart, 0));
  const cv::Rect both = changed(view.draw(at(kGoal), forward_mount(), kGoal, 1));
  EXPECT_GT(both.width, first.width);
  // North is to the right and away: the goal lies higher in the picture, and more to the right.
  OutsideView other(bare(), kStart, kGoal, {320, 240});
  const cv::Rect last = changed(other.draw(at(kGoal), forward_mount(), kGoal, 1));
  EXPECT_GT(last.x + last.width / 2, first.x + first.width / 2);
}

TEST(OutsideView, RefusesNonsense) {
  EXPECT_THROW(OutsideView(bare(), {std::nan(""), 0, 0}, kGoal, {320, 240}), std::invalid_argument);
  EXPECT_THROW(OutsideView(bare(), kStart, kGoal, {10, 10}), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel
