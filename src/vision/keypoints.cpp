#include "kestrel/vision/keypoints.hpp"

#include <cmath>
#include <stdexcept>

#include <opencv2/features2d.hpp>

namespace kestrel {
namespace {

/// cv::SIFT doubles the image with pixel areas aligned (pixel x of the image becomes 2x + 0.5 of
/// the doubled one) and then halves the coordinates as if pixel centres were: x + 0.25.
constexpr double kDoublingBiasPx = 0.25;

/// Below this a window holds no SIFT keypoint: the border the extremum search leaves out is 5 px
/// on each side of the doubled image.
constexpr int kMinWindowPx = 8;

void require(bool holds, const char* message) {
  if (!holds) throw std::invalid_argument(message);
}

bool is_finite(const PixelBox& box) {
  return std::isfinite(box.u) && std::isfinite(box.v) && std::isfinite(box.width) &&
         std::isfinite(box.height);
}

}  // namespace

void SiftOptions::check() const {
  require(octave_layers >= 1 && octave_layers <= 10, "sift.octave_layers: must be 1 to 10");
  require(contrast_threshold >= 0 && contrast_threshold < 1,
          "sift.contrast_threshold: must be at least 0 and below 1");
  require(edge_threshold >= 1 && std::isfinite(edge_threshold),
          "sift.edge_threshold: must be at least 1");
  require(sigma >= 0.5 && sigma <= 10, "sift.sigma: must be 0.5 to 10 px");
  require(max_keypoints >= 1, "sift.max_keypoints: must be at least 1");
}

Keypoints detect_keypoints(const cv::Mat& gray, const PixelBox& window,
                           const SiftOptions& options) {
  require(gray.empty() || gray.type() == CV_8UC1, "image: must be 8-bit grey");
  if (gray.empty() || !is_finite(window)) return {};
  const PixelBox box = clipped(window, gray.cols, gray.rows);
  if (box.width < kMinWindowPx || box.height < kMinWindowPx) return {};
  const cv::Rect crop(int(box.u), int(box.v), int(box.width), int(box.height));
  const auto sift =
      cv::SIFT::create(options.max_keypoints, options.octave_layers, options.contrast_threshold,
                       options.edge_threshold, options.sigma);
  std::vector<cv::KeyPoint> found;
  Keypoints result;
  sift->detectAndCompute(gray(crop), cv::noArray(), found, result.descriptors);
  // cv::SIFT keeps all keypoints as strong as the weakest it keeps; the bound is to hold exactly.
  if (found.size() > std::size_t(options.max_keypoints)) {
    found.resize(std::size_t(options.max_keypoints));
    result.descriptors = result.descriptors.rowRange(0, options.max_keypoints);
  }
  result.at.reserve(found.size());
  for (const cv::KeyPoint& keypoint : found) {
    result.at.push_back({double(keypoint.pt.x) - kDoublingBiasPx + crop.x,
                         double(keypoint.pt.y) - kDoublingBiasPx + crop.y});
  }
  return result;
}

}  // namespace kestrel
