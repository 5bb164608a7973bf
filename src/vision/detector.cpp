#include "kestrel/vision/detector.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <opencv2/features2d.hpp>

namespace kestrel {
namespace {

/// As vision/keypoints: cv::SIFT of OpenCV 4.6 places its keypoints too far right and down.
constexpr double kDoublingBiasPx = 0.25;

/// Keypoints have scales from 1.26 sigma on, and their descriptors reach over 7.5 scales to each
/// side: 15 px for the usual sigma of 1.6. A template of this shorter side holds, at half its size,
/// two such descriptors side by side; of a smaller one most show what lies around it.
constexpr double kSmallSidePx = 128;

/// What is searched for then is as small as enlarging the frame twice would show it (Lowe 2004,
/// section 3.3), but on its own pixels: of a picture blurred so 4 % is left at half their rate,
/// exp(-(pi sigma)^2 / 2), too little to mislead, and the time is that of a quarter of the pixels.
constexpr double kSmallSigmaPx = 0.8;

/// How a frame is searched for a template. Keypoints of a picture are as many as scales fit into
/// it: with the inverse square of sigma.
FastSiftOptions sift_of_frames(const Template& model, const FastSiftOptions& wanted) {
  FastSiftOptions sift = wanted;
  const bool is_small = std::min(model.width(), model.height()) < kSmallSidePx;
  if (!is_small || wanted.is_doubled || wanted.sigma <= kSmallSigmaPx) return sift;
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
  FastSift sift;
  FeatureMatcher matcher;
};

Detector::Detector(const Template& model, const TrackOptions& options)
    : size_{model.width(), model.height()}, options_(options.detect) {
  options_.sift.simd = options_.match.simd = options.simd;
  if (options_.source == SiftSource::Kestrel) {
    options_.sift = sift_of_frames(model, options_.sift);
  }
  memory_ = std::make_unique<Memory>(
      Memory{FastSift(options_.sift), FeatureMatcher(model.features(), options_.match)});
}

Detector::~Detector() = default;
Detector::Detector(Detector&&) noexcept = default;
Detector& Detector::operator=(Detector&&) noexcept = default;

Detection Detector::detect(const cv::Mat& gray, const PixelBox& window) {
  const bool by_opencv = options_.source == SiftSource::OpenCv;
  const SiftPoints reference =
      by_opencv ? opencv_points(gray, window, options_.sift) : SiftPoints();
  const SiftPoints& seen = by_opencv ? reference : memory_->sift.detect(gray, window);
  Detection result;
  result.keypoints = int(seen.at.size());
  result.pairs = memory_->matcher.match(seen);
  result.hypotheses = vote_homographies(result.pairs, size_.width, size_.height, options_.fit);
  return result;
}

}  // namespace kestrel
