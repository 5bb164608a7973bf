#pragma once

#include <Eigen/Core>

#include "kestrel/geometry/homography.hpp"
#include "kestrel/vision/template_blocks.hpp"

namespace kestrel {

/// Largest distance a step moves a corner of the template, in coordinates of warp(); scaled is
/// scaled_from_template().
double reach(const Eigen::Matrix3d& W, const Eigen::Matrix3d& scaled, const TemplateBlocks& blocks);

/// Derivatives of the corners in the image, px, by the parameters of a warp before H.
Matrix8d corner_derivatives(const Homography& H, const Eigen::Matrix3d& scaled,
                            const TemplateBlocks& blocks);

}  // namespace kestrel
