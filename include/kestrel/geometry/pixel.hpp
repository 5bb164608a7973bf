#pragma once

#include <vector>

namespace kestrel {

/// A point in an image, px: u to the right, v down; (0, 0) is the centre of the first pixel
/// (OpenCV's convention; ViSP's vpImagePoint is (v, u)).
struct Pixel {
  double u = 0;
  double v = 0;
};

/// A point on the normalised image plane z = 1 of the camera frame, lens distortion removed.
struct ImagePoint {
  double x = 0;
  double y = 0;
};

/// Axis-aligned rectangle whose first pixel is (u, v): pixels u .. u+width-1, v .. v+height-1.
struct PixelBox {
  double u = 0;
  double v = 0;
  double width = 0;
  double height = 0;
};

/// A point of the template and where it was seen in the image, px.
struct PixelPair {
  Pixel in_template;
  Pixel in_image;
};

/// Distance of two points, px.
double distance(const Pixel& a, const Pixel& b);

/// Centre of the rectangle's pixels.
Pixel centre(const PixelBox& box);

/// The whole pixels that box touches inside an image of this size; width or height 0 when there are
/// none. The empty box at (0, 0) for an empty box and for one with a number that is not finite: a
/// window nobody can place holds nothing.
PixelBox clipped(const PixelBox& box, int image_width, int image_height);

/// Smallest rectangle that holds all points; the empty box at (0, 0) for no points or when one of
/// them is not finite.
PixelBox bounding_box(const std::vector<Pixel>& points);

}  // namespace kestrel
