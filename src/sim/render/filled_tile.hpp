#pragma once

#include <optional>

#include "reading.hpp"
#include "tile_light.hpp"

namespace kestrel::sim_detail {

/// Of the pixel at (u, v).
Footprint footprint_at(const SeenPlane& plane, const Rays& rays, int u, int v);

/// Adds what a tile sees of the one plane that fills it: with one footprint for all its pixels
/// where that is good for these corners, else with one for each run.
void add_filled(const View& view, const SeenPlane& plane, const Rays& rays, const Tile& tile,
                TileLight& sum);

/// How a tile that one plane fills in all views is read at once: in the middle of its motion, each
/// pixel spread by the variance of where the views see it, so that the blur is that of their mean
/// up to its second moment. Empty for another tile, and for motion that a tap does not span.
std::optional<Reading> reading_in_motion(const View* first, std::size_t count, const Rays& rays,
                                         const Tile& tile);

}  // namespace kestrel::sim_detail
