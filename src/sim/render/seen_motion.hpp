#pragma once

#include "rays.hpp"
#include "tile_light.hpp"

namespace kestrel::sim_detail {

/// How far on the normalised image plane what the first view sees lies from where the second sees
/// it: the most on a grid of 9x7 pixels, border to border. 0 where nothing is seen.
double farthest_motion(const View& first, const View& second, const Rays& rays);

}  // namespace kestrel::sim_detail
