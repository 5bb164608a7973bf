#include "kestrel/vision/detector.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <opencv2/features2d.hpp>

namespace kestrel {
namespace {

/// As vision/keypoints: cv::SIFT of OpenCV 4.6 places its keypoints too far right and down.
constexpr double kDoublingBiasPx = 0.25;

/// Keypoints have scales from 1.26 sigma on, and their descriptors reach over 7.5 scales to each
/// side: 15 px for the usual sigma of 1.6. What is seen with this shorter side holds four such
/// descriptors side by side, two at half its size; of what is smaller more and more show what lies
/// around it.
constexpr double kFewPx = 128;

/// What is searched for then is as small as enlarging the frame twice would show it (Lowe 2004,
/// section 3.3), but on its own pixels: of a picture blurred so 4 % is left at half their rate,
/// exp(-(pi sigma)^2 / 2), too little to mislead, and the time is that of a quarter of the pixels.
constexpr double kSmallSigmaPx = 0.8;

/// Keypoints of a picture are as many as scales fit into it: with the inverse square of sigma.
FastSiftOptions small_structures(const FastSiftOptions& wanted) {
  FastSiftOptions sift = wanted;
  const double more = wanted.sigma * wanted.sigma / (kSmallSigmaPx * kSmallSigmaPx);
  sift.sigma = kSmallSigmaPx;
  sift.max_keypoints = int(std::min(more * wanted.max_keypoints, double(kMaxSiftPoints)));
  return sift;
}

/// RootSIFT in 7 bits of a row of cv::SIFT.
Descriptor root(const float* bins) {
  float sum = 0;
  for (int i = 0; i < 128; ++i) sum += bins[i];
  Descriptor descriptor;
  for (int i = 0; i < 128 && sum > 0; ++i) {
    const double value = std::round(256 * std::sqrt(double(bins[i]) / double(sum)));
    descriptor.bin[std::size_t(i)] = std::uint8_t(std::min(value, 127.0));
  }
  return descriptor;
}

/// The reference: cv::SIFT's keypoints in the form of vision/sift.
SiftPoints opencv_points(const cv::Mat& gray, const PixelBox& window,
                         const FastSiftOptions& options) {
  SiftPoints points;
  const PixelBox box = clipped(window, gray.cols, gray.rows);
  if (box.width < 8 || box.height < 8) return points;
  const cv::Rect crop(int(box.u), int(box.v), int(box.width), int(box.height));
  const auto sift =
      cv::SIFT::create(options.max_keypoints, options.octave_layers, options.contrast_threshold,
                       options.edge_threshold, options.sigma);
  std::vector<cv::KeyPoint> found;
  cv::Mat rows;
  sift->detectAndCompute(gray(crop), cv::noArray(), found, rows);
  found.resize(std::min(found.size(), std::size_t(options.max_keypoints)));
  for (std::size_t i = 0; i < found.size(); ++i) {
    const cv::KeyPoint& k = found[i];
    points.at.push_back({float(k.pt.x - kDoublingBiasPx + crop.x),
                         float(k.pt.y - kDoublingBiasPx + crop.y), k.size / 2,
                         float(k.angle * M_PI / 180), k.response});
    points.descriptors.push_back(root(rows.ptr<float>(int(i))));
  }
  return points;
}

}  // namespace

struct Detector::Memory {
  std::optional<FastSift> usual;
  std::optional<FastSift> small;
  FeatureMatcher matcher;
};

Detector::Detector(const Template& model, const TrackOptions& options)
    : size_{model.width(), model.height()}, options_(options.detect) {
  options_.sift.simd = options_.match.simd = options.simd;
  memory_ =
      std::make_unique<Memory>(Memory{{}, {}, FeatureMatcher(model.features(), options_.match)});
  const FastSiftOptions& sift = options_.sift;
  const double shorter_px = std::min(size_.width, size_.height);
  const bool has_smaller = options_.source == SiftSource::Kestrel && !sift.is_doubled &&
                           sift.sigma > kSmallSigmaPx && shorter_px / 2 < kFewPx;
  if (has_smaller) memory_->small.emplace(small_structures(sift));
  if (!has_smaller || shorter_px >= kFewPx) memory_->usual.emplace(sift);
}

Detector::~Detector() = default;
Detector::Detector(Detector&&) noexcept = default;
Detector& Detector::operator=(Detector&&) noexcept = default;

bool Detector::has_second_look(const std::optional<Homography>& expected) const {
  if (!memory_->usual || !memory_->small) return false;
  if (!expected) return true;
  const double shorter_px = std::min(size_.width, size_.height);
  const double area_px2 = std::abs(signed_area(outline(*expected, size_.width, size_.height)));
  return std::sqrt(area_px2 / (size_.width * size_.height)) * shorter_px < kFewPx;
}

Detection Detector::detect(const cv::Mat& gray, const PixelBox& window, Structures structures) {
  const bool by_opencv = options_.source == SiftSource::OpenCv;
  const SiftPoints reference =
      by_opencv ? opencv_points(gray, window, options_.sift) : SiftPoints();
  const bool is_small = !memory_->usual || (structures == Structures::Small && memory_->small);
  FastSift& sift = is_small ? *memory_->small : *memory_->usual;
  const SiftPoints& seen = by_opencv ? reference : sift.detect(gray, window);
  Detection result;
  result.keypoints = int(seen.at.size());
  result.pairs = memory_->matcher.match(seen);
  result.hypotheses = vote_homographies(result.pairs, size_.width, size_.height, options_.fit);
  return result;
}

}  // namespace kestrel
