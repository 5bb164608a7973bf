#pragma once

#include <opencv2/core/mat.hpp>

#include "kestrel/geometry/camera.hpp"
#include "kestrel/geometry/homography.hpp"
#include "kestrel/geometry/pixel.hpp"

namespace kestrel {

/// The picture (8-bit grey) with what the box (px) holds as the camera without its lens would have
/// seen it, stretched so that it fills the box: its sides are the straight lines through where the
/// box's corners are then, those of opposite sides in the mean. A template learned from it is the
/// plane itself up to a homography, not a bent picture of it. Undistorted once, when it is learned;
/// frames never are. Without a lens: the picture. Parts beyond what the lens shows are black.
/// See straight_place for where that lies.
cv::Mat straight_template(const cv::Mat& gray, const PixelBox& box, const Camera& camera);

/// Where what straight_template puts into a box (px) lies in the image of the camera without its
/// lens: straight_from_template, px to px. Without a lens, or where the lens shows a corner
/// nowhere: the box itself.
Homography straight_place(const PixelBox& box, const Camera& camera);

}  // namespace kestrel
