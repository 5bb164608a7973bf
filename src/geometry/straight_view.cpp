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

/// A homography fitted to points all over a template and where each of them goes; `to` gives
/// nothing for what cannot be seen. Empty when fewer than a quarter of them can be.
template <class To>
std::optional<Homography> fitted(double width_px, double height_px, const To& to) {
  std::vector<PixelPair> pairs;
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const Pixel at{(column + 0.5) / kSide * width_px - 0.5,
                     (row + 0.5) / kSide * height_px - 0.5};
      if (const std::optional<Pixel> there = to(at)) pairs.push_back({at, *there});
    }
  }
  if (pairs.size() < kSide * kSide / 4) return std::nullopt;
  return fit_homography(pairs);
}

}  // namespace

std::optional<StraightView> straight_view(const Homography& image_from_template, double width_px,
                                          double height_px, const Camera& camera) {
  if (camera.parameters().lens == Lens::Pinhole) return StraightView{image_from_template, camera};
  const Camera pinhole = without_lens(camera);
  const auto to = [&](const Pixel& at) -> std::optional<Pixel> {
    const Pixel seen = image_from_template * at;
    if (!is_inside(seen, camera.parameters())) return std::nullopt;
    const ImagePoint point = camera.to_image_point(seen);
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) return std::nullopt;
    return pinhole.to_pixel(point);
  };
  const auto fit = fitted(width_px, height_px, to);
  if (!fit) return std::nullopt;
  return StraightView{*fit, pinhole};
}

std::optional<Homography> bent_view(const Homography& straight_from_template, double width_px,
                                    double height_px, const Camera& camera) {
  if (camera.parameters().lens == Lens::Pinhole) return straight_from_template;
  const Camera pinhole = without_lens(camera);
  const auto to = [&](const Pixel& at) -> std::optional<Pixel> {
    const Pixel seen = camera.to_pixel(pinhole.to_image_point(straight_from_template * at));
    return is_inside(seen, camera.parameters()) ? std::optional(seen) : std::nullopt;
  };
  return fitted(width_px, height_px, to);
}

Camera without_lens(const Camera& camera) {
  CameraParameters straight = camera.parameters();
  straight.lens = Lens::Pinhole;
  straight.distortion = {};
  return Camera(straight);
}

}  // namespace kestrel
