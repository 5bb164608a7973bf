#include "kestrel/vision/frame.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace kestrel {
namespace {

Frame with(int type) {
  Frame frame;
  frame.gray = cv::Mat(4, 6, type, cv::Scalar::all(7));
  return frame;
}

TEST(Frame, HasAnImageOnlyWhenEightBitGrey) {
  EXPECT_TRUE(has_image(with(CV_8UC1)));
  EXPECT_FALSE(has_image(Frame()));
  EXPECT_FALSE(has_image(with(CV_8UC3)));
  EXPECT_FALSE(has_image(with(CV_16UC1)));
  EXPECT_FALSE(has_image(with(CV_32FC1)));
}

}  // namespace
}  // namespace kestrel
