#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

#include "kestrel/geometry/pixel.hpp"
#include "kestrel/vision/template_blocks.hpp"

namespace kestrel {

/// A straight, even motion while the shutter is open: a point becomes a line of this length.
struct MotionBlur {
  double length_px = 0;      // of the template, above 0
  double direction_rad = 0;  // from u towards v, 0 to pi
};

/// The motions a template is learned under. Directions 30 degrees apart: one is within 15 degrees
/// of any, and a line of length L lies within L sin(15 degrees) / 2 = 0.13 L of one of them.
/// Lengths each half as long again as the one before, from what blurs a block of 8 px beyond half
/// of it (5 px), at most four and none beyond a quarter of the shorter side, which leaves nothing.
std::vector<MotionBlur> motion_blurs(double width_px, double height_px);

/// The rectangle box (whole pixels, inside the image) of an 8-bit grey image as a camera sees it
/// that moves with all that is in view: each pixel is the mean along the line about it. What lies
/// beyond the image is taken to be as its edge.
cv::Mat blurred(const cv::Mat& gray, const PixelBox& box, const MotionBlur& motion);

/// The rectangle box of an 8-bit grey image, cut into blocks under each of its motion_blurs(), at
/// the levels at which the sharp rectangle has blocks. Half as many as that was cut with: a blurred
/// picture has less to show.
std::vector<TemplateBlocks> blurred_blocks(const cv::Mat& gray, const PixelBox& box,
                                           const TemplateBlocks& sharp);

}  // namespace kestrel
