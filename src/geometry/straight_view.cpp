#include "kestrel/geometry/straight_view.hpp"

#include <cmath>
#include <vector>

namespace kestrel {
namespace {

constexpr int kSide = 8;  // points along each side: enough for the curve of a lens

/// Inside the image, where its size is known.
bool is_inside(const Pixel& p, const CameraParameters& camera) {
  if (!std::isfinite(p.u) || !std::isfinite(p.v)) return false;
  if (camera.width <= 0 || camera.height <= 0) return true;
  return p.u > -0.5 && p.v > -0.5 && p.u < camera.width - 0.5 && p.v < camera.height - 0.5;
}

}  // namespace

std::optional<StraightView> straight_view(const Homography& image_from_template, double width_px,
                                          double height_px, const Camera& camera) {
  if (camera.parameters().lens == Lens::Pinhole) return StraightView{image_from_template, camera};
  CameraParameters straight = camera.parameters();
  straight.lens = Lens::Pinhole;
  straight.distortion = {};
  const Camera pinhole(straight);
  std::vector<PixelPair> pairs;
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const Pixel at{(column + 0.5) / kSide * width_px - 0.5,
                     (row + 0.5) / kSide * height_px - 0.5};
      const Pixel seen = image_from_template * at;
      if (!is_inside(seen, straight)) continue;
      const ImagePoint point = camera.to_image_point(seen);
      if (!std::isfinite(point.x) || !std::isfinite(point.y)) continue;
      pairs.push_back({at, pinhole.to_pixel(point)});
    }
  }
  if (pairs.size() < kSide * kSide / 4) return std::nullopt;
  const auto fit = fit_homography(pairs);
  if (!fit) return std::nullopt;
  return StraightView{*fit, pinhole};
}

}  // namespace kestrel
