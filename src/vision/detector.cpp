#include "kestrel/vision/detector.hpp"

#include <utility>

namespace kestrel {

struct Detector::Memory {
  FastSift sift;
  FeatureMatcher matcher;
};

Detector::Detector(const Template& model, const TrackOptions& options)
    : size_{model.width(), model.height()}, options_(options.detect) {
  options_.sift.simd = options_.match.simd = options.simd;
  memory_ = std::make_unique<Memory>(
      Memory{FastSift(options_.sift), FeatureMatcher(model.features(), options_.match)});
}

Detector::~Detector() = default;
Detector::Detector(Detector&&) noexcept = default;
Detector& Detector::operator=(Detector&&) noexcept = default;

Detection Detector::detect(const cv::Mat& gray, const PixelBox& window) {
  const SiftPoints& seen = memory_->sift.detect(gray, window);
  Detection result;
  result.keypoints = int(seen.at.size());
  result.pairs = memory_->matcher.match(seen);
  result.hypotheses = vote_homographies(result.pairs, size_.width, size_.height, options_.fit);
  return result;
}

}  // namespace kestrel
