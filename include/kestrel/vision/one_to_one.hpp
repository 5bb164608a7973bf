#pragma once

#include <vector>

#include "kestrel/geometry/pixel.hpp"

namespace kestrel {

/// A pair that speaks for a map, and how far off it is, px^2.
struct Witness {
  PixelPair pair;
  double squared_error = 0;
  int index = 0;
};

/// Indices of the witnesses, ascending, such that no two are nearer to each other than
/// same_place_px, in the template or in the image: of those at one place the one of least error
/// stays, because keypoints of several angles are one observation, not several. The order of the
/// witnesses does not matter.
std::vector<int> one_to_one(std::vector<Witness> witnesses, double same_place_px);

}  // namespace kestrel
