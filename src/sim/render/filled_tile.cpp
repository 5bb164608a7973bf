#include "filled_tile.hpp"

#include <algorithm>

namespace kestrel::sim_detail {
namespace {

int middle_column(const Rays& rays, const Tile& tile) {
  return std::min(tile.u + kRun / 2, rays.size().width - 1);
}

/// The plane, where it fills the tile and hides all behind it with one footprint good for all.
const SeenPlane* even_front(const View& view, const std::array<Eigen::Vector3f, 4>& corners) {
  for (const SeenPlane& plane : view.planes) {
    const Extent seen = extent(plane, corners);
    if (seen == Extent::None) continue;
    const bool fills = seen == Extent::All && plane.opacity == 1 && is_even(plane, corners);
    return fills ? &plane : nullptr;
  }
  return nullptr;
}

SeenPlane shifted(SeenPlane plane, const Eigen::Vector2f& texels) {
  const Eigen::RowVector3f inverse_depth = plane.texture_from_ray.row(2);
  plane.texture_from_ray.topRows<2>() += texels * inverse_depth;
  return plane;
}

/// Of places of equal weight.
struct Spread {
  Eigen::Vector2f mean;
  Eigen::Matrix2f covariance;
};

Spread spread(const std::vector<Eigen::Vector2f>& places) {
  Spread all{Eigen::Vector2f::Zero(), Eigen::Matrix2f::Zero()};
  const float share = 1 / float(places.size());
  for (const Eigen::Vector2f& place : places) all.mean += share * place;
  for (const Eigen::Vector2f& place : places) {
    all.covariance += share * (place - all.mean) * (place - all.mean).transpose();
  }
  return all;
}

}  // namespace

Footprint footprint_at(const SeenPlane& plane, const Rays& rays, int u, int v) {
  return footprint(plane, rays.ray(u, v), rays.ray(u + 1, v), rays.ray(u, v + 1));
}

void add_filled(const View& view, const SeenPlane& plane, const Rays& rays, const Tile& tile,
                TileLight& sum) {
  const int rows = is_even(plane, rays.corners(tile)) ? tile.rows : 1;
  for (int row = 0; row < tile.rows; row += rows) {
    const int v = tile.v + row;
    const Footprint f = footprint_at(plane, rays, middle_column(rays, tile), v + rows / 2);
    view.add_mean_light(reading(plane, f), rays.run(tile.u, v), rows, &sum[begin_of_row(row)]);
  }
}

std::optional<Reading> reading_in_motion(const View* first, std::size_t count, const Rays& rays,
                                         const Tile& tile) {
  const auto corners = rays.corners(tile);
  const int u = middle_column(rays, tile);
  const int v = tile.v + tile.rows / 2;
  const SeenPlane* middle = nullptr;
  std::vector<Eigen::Vector2f> places;
  for (std::size_t i = 0; i < count; ++i) {
    const SeenPlane* const plane = even_front(first[i], corners);
    if (!plane || (middle && middle->texture != plane->texture)) return std::nullopt;
    if (i <= count / 2) middle = plane;
    const Eigen::Vector3f at = plane->texture_from_ray * rays.ray(u, v);
    places.emplace_back(at.head<2>() / at.z());
  }
  const Spread all = spread(places);
  return spread_reading(shifted(*middle, all.mean - places[count / 2]),
                        footprint_at(*middle, rays, u, v), all.covariance);
}

}  // namespace kestrel::sim_detail
