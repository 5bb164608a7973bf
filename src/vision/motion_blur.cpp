#include "kestrel/vision/motion_blur.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "sift/exact_math.hpp"

namespace kestrel {
namespace {

constexpr int kDirections = 6;
constexpr double kShortest_px = 5;
constexpr double kNextLength = 1.5;
constexpr int kMostLengths = 4;
constexpr double kMostOfSide = 0.25;
constexpr double kPi = 3.141592653589793;

/// Samples of a line for each pixel of its length: more changes nothing of eight bits.
constexpr int kSamplesPerPx = 8;

void add(cv::Mat& kernel, double u, double v, double weight) {
  const int left = int(std::floor(u));
  const int top = int(std::floor(v));
  const double a = u - left;
  const double b = v - top;
  kernel.at<float>(top, left) += float(weight * (1 - a) * (1 - b));
  kernel.at<float>(top, left + 1) += float(weight * a * (1 - b));
  kernel.at<float>(top + 1, left) += float(weight * (1 - a) * b);
  kernel.at<float>(top + 1, left + 1) += float(weight * a * b);
}

/// A line through the middle of a square of 2 radius + 1 px.
cv::Mat line_kernel(const MotionBlur& motion, int radius) {
  cv::Mat kernel(2 * radius + 1, 2 * radius + 1, CV_32F, cv::Scalar(0));
  const sift::Direction along = sift::direction(motion.direction_rad);
  const int samples = int(std::ceil(motion.length_px * kSamplesPerPx));
  for (int i = 0; i < samples; ++i) {
    const double at = ((i + 0.5) / samples - 0.5) * motion.length_px;
    add(kernel, radius + at * along.cosine, radius + at * along.sine, 1.0 / samples);
  }
  return kernel;
}

}  // namespace

std::vector<MotionBlur> motion_blurs(double width_px, double height_px) {
  const double longest = kMostOfSide * std::min(width_px, height_px);
  std::vector<MotionBlur> result;
  double length_px = kShortest_px;
  for (int i = 0; i < kMostLengths && length_px <= longest; ++i) {
    for (int k = 0; k < kDirections; ++k) result.push_back({length_px, k * kPi / kDirections});
    length_px *= kNextLength;
  }
  return result;
}

cv::Mat blurred(const cv::Mat& gray, const PixelBox& box, const MotionBlur& motion) {
  const int radius = int(std::ceil(motion.length_px / 2)) + 1;
  const cv::Rect rect(int(box.u), int(box.v), int(box.width), int(box.height));
  const cv::Rect around = (rect + cv::Size(2 * radius, 2 * radius) - cv::Point(radius, radius)) &
                          cv::Rect(0, 0, gray.cols, gray.rows);
  cv::Mat result;
  cv::filter2D(gray(around), result, CV_8U, line_kernel(motion, radius), {-1, -1}, 0,
               cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
  return result(rect - around.tl()).clone();
}

std::vector<TemplateBlocks> blurred_blocks(const cv::Mat& gray, const PixelBox& box,
                                           const BlockOptions& options) {
  BlockOptions fewer = options;
  fewer.max_blocks = std::max(options.max_blocks / 2, 4);
  fewer.max_coarse_blocks = std::max(options.max_coarse_blocks / 2, 4);
  std::vector<TemplateBlocks> result;
  for (const MotionBlur& motion : motion_blurs(box.width, box.height)) {
    result.push_back(template_blocks(blurred(gray, box, motion), fewer));
  }
  return result;
}

}  // namespace kestrel
