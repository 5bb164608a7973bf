#include "bench/stress_light.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "bench/stress_motion.hpp"
#include "bench/stress_scene.hpp"
#include "bench/stress_texture.hpp"

namespace kestrel::test {
namespace {

cv::Mat even(double grey) { return {480, 640, CV_32F, cv::Scalar(grey)}; }

cv::Scalar mean_and_deviation(const cv::Mat& gray) {
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(gray, mean, deviation);
  return {mean[0], deviation[0]};
}

TEST(StressLight, ContrastTurnsAboutTheMiddleGrey) {
  StressLight light;
  light.gain = 0.5;
  light.bias_grey = -10;
  EXPECT_DOUBLE_EQ(mean_and_deviation(exposed(even(200), light, {}, "a"))[0], 154);
  EXPECT_DOUBLE_EQ(mean_and_deviation(exposed(even(128), light, {}, "a"))[0], 118);
}

/// 307 200 pixels: the mean is known to 0.02 grey levels, the deviation to 0.2 %; rounding to whole
/// levels adds 1/12 to a variance of 64.
TEST(StressLight, NoiseHasItsDeviationAndRepeats) {
  const std::vector<float> table = noise_table("test");
  StressLight light;
  light.noise_grey = 8;
  const cv::Mat noisy = exposed(even(128), light, table, "a");
  EXPECT_NEAR(mean_and_deviation(noisy)[0], 128, 0.3);  // rows share a table of 262 144 numbers
  EXPECT_NEAR(mean_and_deviation(noisy)[1], 8, 0.15);
  EXPECT_EQ(cv::norm(noisy, exposed(even(128), light, table, "a"), cv::NORM_INF), 0);
  EXPECT_GT(cv::norm(noisy, exposed(even(128), light, table, "b"), cv::NORM_INF), 0);
}

TEST(StressLight, ShadeAndShadowLieWhereTheySay) {
  StressLight light;
  light.shade = 0.2;
  light.shade_angle = 0;  // brighter to the right
  const cv::Mat shaded = exposed(even(100), light, {}, "a");
  EXPECT_NEAR(shaded.at<uchar>(240, 639), 120, 1);
  EXPECT_NEAR(shaded.at<uchar>(240, 0), 80, 1);
  light.shade = 0;
  light.shadow = 0.4;
  light.shadow_at_px = 100;  // darker beyond column 420
  const cv::Mat shadowed = exposed(even(100), light, {}, "a");
  EXPECT_EQ(shadowed.at<uchar>(240, 0), 100);
  EXPECT_NEAR(shadowed.at<uchar>(240, 420), 80, 1);
  EXPECT_EQ(shadowed.at<uchar>(240, 639), 60);
}

TEST(StressLight, DefocusKeepsTheLightAndTheContrastGoes) {
  cv::Mat stripes = even(100);
  for (int u = 0; u < stripes.cols; u += 4) stripes(cv::Rect(u, 0, 2, 480)).setTo(200);
  StressLight light;
  light.defocus_px = 2;
  const auto blurred = mean_and_deviation(exposed(stripes, light, {}, "a"));
  EXPECT_NEAR(blurred[0], 150, 0.6);
  EXPECT_LT(blurred[1], 3);  // exp(-(2 pi / 4)^2 2^2 / 2) = 0.7 % of the stripes are left
}

/// What the occluder covers shows nothing of what is behind it, and the rest nothing of it.
TEST(StressScene, TheOccluderHidesWhatItCovers) {
  const StressTexture texture = stress_texture("board");
  if (!std::filesystem::exists(texture.file)) GTEST_SKIP() << "opencv-doc is not installed";
  const StressScene scene("occlusion", texture, {206, 154});
  cv::Mat before_white = even(255);
  cv::Mat before_black = even(0);
  const TargetPose pose = StressPose{}.camera_from_target();
  scene.occlude(before_white, pose);
  scene.occlude(before_black, pose);
  const cv::Mat through = before_white - before_black;
  const int half = int(occluder_side_m({206, 154}) * kPxPerMetre / 2);
  for (int v = 0; v < through.rows; ++v) {
    for (int u = 0; u < through.cols; ++u) {
      const double off = std::max(std::abs(u - 319.5), std::abs(v - 239.5));
      if (std::abs(off - half) < 2) continue;  // the edge
      ASSERT_EQ(through.at<float>(v, u), off < half ? 0 : 255) << u << " " << v;
    }
  }
  EXPECT_GT(before_black.at<float>(240, 320), 0);
}

}  // namespace
}  // namespace kestrel::test
