#include "kestrel/geometry/pixel.hpp"

#include <algorithm>
#include <cmath>

namespace kestrel {

double distance(const Pixel& a, const Pixel& b) { return std::hypot(a.u - b.u, a.v - b.v); }

Pixel centre(const PixelBox& box) {
  return {box.u + (box.width - 1) / 2, box.v + (box.height - 1) / 2};
}

PixelBox clipped(const PixelBox& box, int image_width, int image_height) {
  const double end_u = box.u + box.width;
  const double end_v = box.v + box.height;
  if (!std::isfinite(end_u) || !std::isfinite(end_v) || !std::isfinite(box.u) ||
      !std::isfinite(box.v)) {
    return {};
  }
  if (!(box.width > 0 && box.height > 0)) return {};
  const double image_end_u = std::max(image_width, 0);
  const double image_end_v = std::max(image_height, 0);
  const double left = std::clamp(std::floor(box.u), 0.0, image_end_u);
  const double top = std::clamp(std::floor(box.v), 0.0, image_end_v);
  const double right = std::clamp(std::ceil(end_u), left, image_end_u);
  const double bottom = std::clamp(std::ceil(end_v), top, image_end_v);
  return {left, top, right - left, bottom - top};
}

PixelBox bounding_box(const std::vector<Pixel>& points) {
  if (points.empty()) return {};
  Pixel low = points.front();
  Pixel high = points.front();
  for (const Pixel& p : points) {
    if (!std::isfinite(p.u) || !std::isfinite(p.v)) return {};
    low = {std::min(low.u, p.u), std::min(low.v, p.v)};
    high = {std::max(high.u, p.u), std::max(high.v, p.v)};
  }
  return {low.u, low.v, high.u - low.u + 1, high.v - low.v + 1};
}

}  // namespace kestrel
