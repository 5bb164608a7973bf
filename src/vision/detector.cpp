#include "kestrel/vision/detector.hpp"

#include <utility>

namespace kestrel {

struct Detector::Memory {
  FastSift sift;
  FeatureMatcher matcher;
};

Detector::Detector(const TrackOptions& options)
    : options_(options),
      memory_(std::make_unique<Memory>(Memory{FastSift(sift_of(options)), FeatureMatcher()})) {}

Detector::~Detector() = default;
Detector::Detector(Detector&&) noexcept = default;
Detector& Detector::operator=(Detector&&) noexcept = default;

Detection Detector::detect(const Template& model, const cv::Mat& gray, const PixelBox& window) {
  Detection result;
  const SiftPoints& seen = memory_->sift.detect(gray, window);
  result.keypoints = int(seen.at.size());
  result.pairs = match_features(model.features(), seen, options_.detect.match);
  result.hypotheses =
      vote_homographies(result.pairs, model.width(), model.height(), options_.detect.fit);
  return result;
}

}  // namespace kestrel
