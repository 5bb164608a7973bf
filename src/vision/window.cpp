#include "kestrel/vision/window.hpp"

#include <algorithm>
#include <cmath>

namespace kestrel {
namespace {

/// A SIFT descriptor of the finest scale reaches about 12 px to each side: a smaller window would
/// not hold the whole of any keypoint well inside it.
constexpr double kMinSidePx = 64;

PixelBox whole(int image_width, int image_height) {
  return {0, 0, double(image_width), double(image_height)};
}

bool is_usable(const PixelBox& box) {
  return std::isfinite(box.u) && std::isfinite(box.v) && std::isfinite(box.width) &&
         std::isfinite(box.height) && box.width > 0 && box.height > 0;
}

/// Box of this size about a point, moved and cut as little as needed to lie inside the image.
PixelBox placed(const Pixel& at, double width, double height, int image_width, int image_height) {
  const double w = std::min(width, double(image_width));
  const double h = std::min(height, double(image_height));
  return {std::clamp(at.u - (w - 1) / 2, 0.0, image_width - w),
          std::clamp(at.v - (h - 1) / 2, 0.0, image_height - h), w, h};
}

PixelBox twice(const PixelBox& box, int image_width, int image_height) {
  return placed(centre(box), std::max(2 * box.width, kMinSidePx),
                std::max(2 * box.height, kMinSidePx), image_width, image_height);
}

/// What bounding_box() returns, without memory: this runs in every frame.
PixelBox box_of(const std::array<Pixel, 4>& corners) {
  const auto [left, right] = std::minmax({corners[0].u, corners[1].u, corners[2].u, corners[3].u});
  const auto [top, bottom] = std::minmax({corners[0].v, corners[1].v, corners[2].v, corners[3].v});
  return {left, top, right - left + 1, bottom - top + 1};
}

}  // namespace

PixelBox first_window(const PixelBox& template_box, int image_width, int image_height) {
  if (!is_usable(template_box)) return whole(image_width, image_height);
  return twice(template_box, image_width, image_height);
}

PixelBox window_around(const std::array<Pixel, 4>& outline, int image_width, int image_height) {
  for (const Pixel& corner : outline) {
    if (!std::isfinite(corner.u) || !std::isfinite(corner.v)) {
      return whole(image_width, image_height);
    }
  }
  return twice(box_of(outline), image_width, image_height);
}

PixelBox doubled_window(const PixelBox& window, int image_width, int image_height) {
  if (!is_usable(window)) return whole(image_width, image_height);
  const double area = 2 * window.width * window.height;
  const double grow = std::sqrt(2.0);
  double width = std::min(grow * window.width, double(image_width));
  const double height = std::min(area / width, double(image_height));
  width = std::min(area / height, double(image_width));
  return placed(centre(window), width, height, image_width, image_height);
}

}  // namespace kestrel
