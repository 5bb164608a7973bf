#include "kestrel/vision/blur.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>

#include "sift/exact_math.hpp"

namespace kestrel {
namespace {

constexpr int kDirections = 6;
constexpr double kShortest_px = 5;
constexpr double kNextLength = 1.5;
constexpr int kMostLengths = 4;
constexpr double kMostOfSide = 0.25;
constexpr double kPi = 3.141592653589793;

/// Samples for each pixel of a length: more changes nothing of eight bits.
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
cv::Mat line_kernel(const Blur& blur, int radius) {
  cv::Mat kernel(2 * radius + 1, 2 * radius + 1, CV_32F, cv::Scalar(0));
  const sift::Direction along = sift::direction(blur.direction_rad);
  const int samples = int(std::ceil(blur.length_px * kSamplesPerPx));
  for (int i = 0; i < samples; ++i) {
    const double at = ((i + 0.5) / samples - 0.5) * blur.length_px;
    add(kernel, radius + at * along.cosine, radius + at * along.sine, 1.0 / samples);
  }
  return kernel;
}

/// A disc in the middle of the square: of each pixel the share that the disc covers.
cv::Mat disc_kernel(const Blur& blur, int radius) {
  cv::Mat kernel(2 * radius + 1, 2 * radius + 1, CV_32F, cv::Scalar(0));
  const double disc2_px2 = blur.length_px * blur.length_px / 3;
  const int samples = kernel.rows * kSamplesPerPx;
  int inside = 0;
  for (int j = 0; j < samples; ++j) {
    for (int i = 0; i < samples; ++i) {
      const double u = (i + 0.5) / kSamplesPerPx - 0.5 - radius;
      const double v = (j + 0.5) / kSamplesPerPx - 0.5 - radius;
      if (u * u + v * v > disc2_px2) continue;
      kernel.at<float>(j / kSamplesPerPx, i / kSamplesPerPx) += 1;
      ++inside;
    }
  }
  kernel /= inside;
  return kernel;
}

/// What a point becomes, in the middle of a square.
cv::Mat kernel(const Blur& blur) {
  // A line reaches half its length, a disc 1 / sqrt(3) of it; sharing among pixels takes one more.
  const bool is_line = blur.shape == BlurShape::Line;
  const int radius = int(std::ceil(blur.length_px * (is_line ? 0.5 : std::sqrt(1.0 / 3)))) + 1;
  return is_line ? line_kernel(blur, radius) : disc_kernel(blur, radius);
}

/// Of a kernel what is not 0: a line is a tenth of its square, a disc three quarters.
struct Tap {
  int x = 0;
  int y = 0;
  float weight = 0;
};

std::vector<Tap> taps(const cv::Mat& kernel) {
  std::vector<Tap> result;
  for (int y = 0; y < kernel.rows; ++y) {
    for (int x = 0; x < kernel.cols; ++x) {
      const float weight = kernel.at<float>(y, x);
      if (weight > 0) result.push_back({x, y, weight});
    }
  }
  return result;
}

/// The rectangle and so many pixels about it.
cv::Mat with_border(const cv::Mat& gray, const PixelBox& box, int radius) {
  const cv::Rect wanted(int(box.u) - radius, int(box.v) - radius, int(box.width) + 2 * radius,
                        int(box.height) + 2 * radius);
  const cv::Rect there = wanted & cv::Rect(0, 0, gray.cols, gray.rows);
  cv::Mat result;
  cv::copyMakeBorder(gray(there), result, there.y - wanted.y, wanted.br().y - there.br().y,
                     there.x - wanted.x, wanted.br().x - there.br().x,
                     cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
  result.convertTo(result, CV_32F);
  return result;
}

}  // namespace

std::vector<Blur> blurs(double width_px, double height_px) {
  const double longest = kMostOfSide * std::min(width_px, height_px);
  std::vector<Blur> result;
  double length_px = kShortest_px;
  for (int i = 0; i < kMostLengths && length_px <= longest; ++i) {
    for (int k = 0; k < kDirections; ++k) {
      result.push_back({length_px, k * kPi / kDirections});
    }
    result.push_back({length_px, 0, BlurShape::Disc});
    length_px *= kNextLength;
  }
  return result;
}

cv::Mat blurred(const cv::Mat& gray, const PixelBox& box, const Blur& blur) {
  const cv::Mat square = kernel(blur);
  const std::vector<Tap> spread = taps(square);
  const cv::Mat around = with_border(gray, box, square.rows / 2);
  cv::Mat result(int(box.height), int(box.width), CV_8UC1);
  std::vector<float> sum(std::size_t(result.cols));
  for (int y = 0; y < result.rows; ++y) {
    std::fill(sum.begin(), sum.end(), 0.5F);  // to round
    for (const Tap& tap : spread) {
      const float* from = around.ptr<float>(y + tap.y) + tap.x;
      for (std::size_t x = 0; x < sum.size(); ++x) sum[x] += tap.weight * from[x];
    }
    auto* to = result.ptr<uchar>(y);
    for (std::size_t x = 0; x < sum.size(); ++x) to[x] = uchar(std::min(int(sum[x]), 255));
  }
  return result;
}

std::vector<TemplateBlocks> blurred_blocks(const cv::Mat& gray, const PixelBox& box,
                                           const TemplateBlocks& sharp) {
  BlockOptions fewer = sharp.options;
  fewer.max_blocks = std::max(fewer.max_blocks / 2, 4);
  fewer.max_coarse_blocks = std::max(fewer.max_coarse_blocks / 2, 4);
  std::vector<TemplateBlocks> result;
  for (const Blur& blur : blurs(box.width, box.height)) {
    result.push_back(template_blocks(blurred(gray, box, blur), fewer, sharp));
  }
  return result;
}

}  // namespace kestrel
