#pragma once

#include <vector>

#include "kestrel/geometry/homography.hpp"
#include "kestrel/geometry/pixel.hpp"

namespace kestrel {

/// How far the inliers leave the outline undetermined, px: root mean square distance of the
/// template's four corners in the image from where they would be without noise, by first-order
/// propagation of the inliers' noise through a least-squares fit (Hartley & Zisserman 2004, section
/// 5.2.3). The noise of a coordinate is taken from the residuals, but never below half a pixel: a
/// few pairs can agree by chance. Infinite when the pairs do not determine a homography.
///
/// Keypoints crowded in one part of the template can agree perfectly and still say little about the
/// rest of it: counting inliers does not show that, this does.
double outline_deviation_px(const Homography& image_from_template,
                            const std::vector<PixelPair>& inliers, double width_px,
                            double height_px);

}  // namespace kestrel
