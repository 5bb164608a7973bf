#include "kestrel/vision/outline_deviation.hpp"

#include <cmath>

#include "kestrel/vision/corner_covariance.hpp"

namespace kestrel {
namespace {

constexpr double kLeastNoisePx = 0.5;

}  // namespace

double outline_deviation_px(const Homography& image_from_template,
                            const std::vector<PixelPair>& inliers, double width_px,
                            double height_px) {
  const CornerCovariance C =
      corner_covariance(image_from_template, inliers, width_px, height_px, kLeastNoisePx);
  return std::sqrt(C.trace() / 4);
}

}  // namespace kestrel
