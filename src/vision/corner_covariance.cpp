#include "kestrel/vision/corner_covariance.hpp"

#include <algorithm>
#include <limits>

#include <Eigen/Cholesky>

#include "kestrel/vision/homography_step.hpp"

namespace kestrel {
namespace {

CornerCovariance unknown() {
  const double infinite = std::numeric_limits<double>::infinity();
  CornerCovariance C = CornerCovariance::Zero();
  C.diagonal().setConstant(infinite);
  return C;
}

}  // namespace

CornerCovariance corner_covariance(const Homography& image_from_template,
                                   const std::vector<PixelPair>& pairs, double width_px,
                                   double height_px, double least_noise_px) {
  const CentredHomography model = centred(image_from_template, width_px, height_px);
  HomographyStep sums(model);
  double squared = 0;
  for (const PixelPair& pair : pairs) {
    const Eigen::Vector2d p = centred(pair.in_template, width_px, height_px);
    const Seen at = seen(model, p);
    squared += (at.u - pair.in_image.u) * (at.u - pair.in_image.u) +
               (at.v - pair.in_image.v) * (at.v - pair.in_image.v);
    sums.add(p, pair.in_image, 1);
  }
  const Eigen::LLT<CornerCovariance> factor(sums.information());
  if (pairs.size() < 4 || factor.info() != Eigen::Success) return unknown();
  CornerCovariance J;
  Eigen::Index row = 0;
  for (const Pixel& corner : template_corners(width_px, height_px)) {
    J.middleRows<2>(row) = HomographyStep::jacobian(model, centred(corner, width_px, height_px));
    row += 2;
  }
  // 2n numbers, eight of them spent on the fit.
  const double freedom = 2.0 * double(pairs.size()) - 8;
  const double variance =
      std::max(least_noise_px * least_noise_px, freedom > 0 ? squared / freedom : 0);
  const CornerCovariance X = factor.matrixL().solve(J.transpose());
  const CornerCovariance C = variance * (X.transpose() * X);
  return C.allFinite() ? C : unknown();
}

}  // namespace kestrel
