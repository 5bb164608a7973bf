#pragma once

#include <array>
#include <vector>

#include "kernels.hpp"
#include "rays.hpp"
#include "seen_plane.hpp"

namespace kestrel::sim_detail {

/// Grey levels, row by row.
constexpr std::size_t kTilePixels = std::size_t(kRun) * kRun;
using TileLight = std::array<float, kTilePixels>;

/// Where a row of them begins.
constexpr std::size_t begin_of_row(int row) { return std::size_t(row) * kRun; }

/// What a camera sees at an instant, and by what its light is read.
struct View {
  std::vector<SeenPlane> planes;  // front to back
  float background = 0;           // grey level
  AddMeanLight add_mean_light = add_mean_light_baseline;
};

/// Mean light over each pixel of the tile: a sum over the views. A tile that one plane fills is
/// read at once; elsewhere the planes blend, run by run, by the share of each pixel they cover.
TileLight sum_of_views(const std::vector<View>& views, const Rays& rays, const Tile& tile);

}  // namespace kestrel::sim_detail
