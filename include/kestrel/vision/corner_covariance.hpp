#pragma once

#include <vector>

#include <Eigen/Core>

#include "kestrel/geometry/homography.hpp"
#include "kestrel/geometry/pixel.hpp"

namespace kestrel {

/// Covariance, px^2, of the eight numbers (u0, v0, ..., u3, v3).
using CornerCovariance = Eigen::Matrix<double, 8, 8>;

/// Covariance of the template's corners in the image, in the order of template_corners(), when
/// image_from_template is the least-squares fit of these pairs: the noise of their places in the
/// image, carried through the fit to first order (Hartley & Zisserman 2004, section 5.2.3). The
/// noise of a coordinate is taken from the residuals, but never below least_noise_px: a few pairs
/// can agree by chance. Infinite on the diagonal, 0 elsewhere, when the pairs do not determine a
/// homography.
CornerCovariance corner_covariance(const Homography& image_from_template,
                                   const std::vector<PixelPair>& pairs, double width_px,
                                   double height_px, double least_noise_px);

}  // namespace kestrel
