#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

#include "kestrel/geometry/pixel.hpp"
#include "kestrel/vision/template_blocks.hpp"

namespace kestrel {

/// What a point becomes.
enum class BlurShape {
  Line,  // a straight, even motion while the shutter is open
  Disc,  // a lens out of focus, or motion to and fro in all directions
};

/// How an image is blurred. The length of a disc is that of the line whose points lie as far from
/// its middle along it, root mean square, as the disc's do along any line: sqrt(3) times its
/// radius, sqrt(12) times the standard deviation of a bell of the same width.
struct Blur {
  double length_px = 0;      // of the template, above 0
  double direction_rad = 0;  // of a line, from u towards v, 0 to pi
  BlurShape shape = BlurShape::Line;
};

/// The blurs a template is learned under: for each length six lines, then a disc. Directions 30
/// degrees apart: one is within 15 degrees of any, and a line of length L lies within
/// L sin(15 degrees) / 2 = 0.13 L of one of them. Lengths each half as long again as the one
/// before, from what blurs a block of 8 px beyond half of it (5 px), at most four and none beyond a
/// quarter of the shorter side, which leaves nothing.
std::vector<Blur> blurs(double width_px, double height_px);

/// The rectangle box (whole pixels, inside the image) of an 8-bit grey image as a camera sees it
/// whose blur is the same in all of the view: each pixel is the mean over the line or the disc
/// about it. What lies beyond the image is taken to be as its edge.
cv::Mat blurred(const cv::Mat& gray, const PixelBox& box, const Blur& blur);

/// The rectangle box of an 8-bit grey image, cut into blocks under each of its blurs(), at the
/// levels at which the sharp rectangle has blocks. Half as many as that was cut with: a blurred
/// picture has less to show.
std::vector<TemplateBlocks> blurred_blocks(const cv::Mat& gray, const PixelBox& box,
                                           const TemplateBlocks& sharp);

}  // namespace kestrel
