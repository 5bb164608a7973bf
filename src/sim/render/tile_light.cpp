#include "tile_light.hpp"

#include <algorithm>
#include <cmath>

#include "coverage.hpp"
#include "filled_tile.hpp"
#include "reading.hpp"

namespace kestrel::sim_detail {
namespace {

/// A plane of which a tile sees something.
struct Layer {
  const SeenPlane* plane;
  Extent extent;
};

/// Front to back, down to the first that hides all behind it.
std::vector<Layer> layers(const View& view, const std::array<Eigen::Vector3f, 4>& corners) {
  std::vector<Layer> result;
  for (const SeenPlane& plane : view.planes) {
    const Extent seen = extent(plane, corners);
    if (seen == Extent::None) continue;
    result.push_back({&plane, seen});
    if (seen == Extent::All && plane.opacity == 1) break;
  }
  return result;
}

bool is_finite(const Footprint& f) { return std::isfinite(f.sa + f.ta + f.sb + f.tb); }

/// What one plane gives to a run of pixels.
struct Shades {
  Run cover{};  // share of the pixel, 0..1
  Run light{};  // grey level, where cover > 0
};

/// Of a plane that covers all of it.
Shades full_shades(const View& view, const SeenPlane& plane, const Rays& rays, int u, int v) {
  Shades shades;
  shades.cover.fill(1);
  const int middle = std::min(u + kRun / 2, rays.size().width - 1);
  const Footprint f = footprint_at(plane, rays, middle, v);
  view.add_mean_light(reading(plane, f), rays.run(u, v), 1, shades.light.data());
  return shades;
}

/// A pixel's extent along one side of the texture.
struct Span {
  float middle;
  float share;  // of the whole pixel's
};

/// What of it lies within [0, length].
Span within(float middle, float reach, float length) {
  const float low = std::max(middle - reach, 0.f);
  const float high = std::min(middle + reach, length);
  if (!(high > low)) return {middle, 1};
  return {(low + high) / 2, (high - low) / (2 * reach)};
}

/// Mean light over that part of a footprint at (s, t) which lies on the texture. Beyond its edge
/// the edge's texels would be read: a dark rim would fill the whole share of the pixel that is
/// covered.
float light_on_texture(const View& view, const SeenPlane& plane, float s, float t, Footprint f) {
  const Span across = within(s, (std::abs(f.sa) + std::abs(f.sb)) / 2, plane.texture->width());
  const Span down = within(t, (std::abs(f.ta) + std::abs(f.tb)) / 2, plane.texture->height());
  const Footprint part{f.sa * across.share, f.ta * down.share, f.sb * across.share,
                       f.tb * down.share};
  SeenPlane there = plane;
  there.texture_from_ray << 0, 0, across.middle, 0, 0, down.middle, 0, 0, 1;
  constexpr std::array<float, std::size_t(2) * kRun> kAnyRays{};
  Run light{};
  view.add_mean_light(reading(there, part), kAnyRays.data(), 1, light.data());
  return light[0];
}

/// The shape of the footprint is taken to be the same along the run.
Shades shades(const View& view, const SeenPlane& plane, const Rays& rays, int u, int v) {
  const auto [s, t, w] = on_texture(plane.texture_from_ray, rays.run(u, v));
  const int k = pixel_on_plane(w);
  if (k < 0) return {};
  const Footprint f = footprint_at(plane, rays, u + k, v);
  if (!is_finite(f)) return {};
  Shades shades;
  shades.cover = cover(w, slabs(w, s, plane.texture->width(), f.sa, f.sb),
                       slabs(w, t, plane.texture->height(), f.ta, f.tb));
  if (is_all(shades.cover, 0)) return shades;
  view.add_mean_light(reading(plane, f), rays.run(u, v), 1, shades.light.data());
  for (std::size_t i = 0; i < kRun; ++i) {
    if (shades.cover[i] > 0 && shades.cover[i] < 1) {
      shades.light[i] = light_on_texture(view, plane, s[i], t[i], f);
    }
  }
  return shades;
}

/// Adds what a run sees of planes that cover parts of its pixels.
void add_blend(const View& view, const std::vector<Layer>& layers, const Rays& rays, int u, int v,
               float* sum) {
  Run light{};
  Run open;  // share of the pixel that nothing covers yet
  open.fill(1);
  for (const Layer& layer : layers) {
    const Shades shaded = layer.extent == Extent::All ? full_shades(view, *layer.plane, rays, u, v)
                                                      : shades(view, *layer.plane, rays, u, v);
    for (std::size_t k = 0; k < kRun; ++k) {
      const float cover = shaded.cover[k] * layer.plane->opacity;
      light[k] += open[k] * cover * shaded.light[k];
      open[k] *= 1 - cover;
    }
    if (is_all(open, 0)) break;
  }
  for (std::size_t k = 0; k < kRun; ++k) sum[k] += light[k] + open[k] * view.background;
}

void add_view(const View& view, const Rays& rays, const Tile& tile, TileLight& sum) {
  const auto corners = rays.corners(tile);
  const std::vector<Layer> seen = layers(view, corners);
  if (seen.empty()) {
    for (float& light : sum) light += view.background;
    return;
  }
  const SeenPlane& front = *seen.front().plane;
  if (seen.front().extent == Extent::All && front.opacity == 1) {
    return add_filled(view, front, rays, tile, sum);
  }
  for (int row = 0; row < tile.rows; ++row) {
    add_blend(view, seen, rays, tile.u, tile.v + row, &sum[begin_of_row(row)]);
  }
}

/// Adds consecutive views: at once where the motion from the first to the last is small, else the
/// two halves of them.
void add_views(const View* first, std::size_t count, const Rays& rays, const Tile& tile,
               TileLight& sum) {
  if (count == 1) return add_view(*first, rays, tile, sum);
  if (const std::optional<Reading> reading = reading_in_motion(first, count, rays, tile)) {
    TileLight mean{};
    first->add_mean_light(*reading, rays.run(tile.u, tile.v), tile.rows, mean.data());
    for (std::size_t k = 0; k < mean.size(); ++k) sum[k] += float(count) * mean[k];
    return;
  }
  add_views(first, count / 2, rays, tile, sum);
  add_views(first + count / 2, count - count / 2, rays, tile, sum);
}

}  // namespace

TileLight sum_of_views(const std::vector<View>& views, const Rays& rays, const Tile& tile) {
  TileLight sum{};
  add_views(views.data(), views.size(), rays, tile, sum);
  return sum;
}

}  // namespace kestrel::sim_detail
