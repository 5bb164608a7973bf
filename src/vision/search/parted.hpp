#pragma once

#include <cstddef>
#include <vector>

#include "kestrel/geometry/pixel.hpp"

namespace kestrel {

/// Matches in two.
struct PartedPairs {
  std::vector<PixelPair> inliers;
  std::vector<PixelPair> others;
};

/// Those at these ascending indices, and the others, both in their order. Pair: with in_template
/// and in_image.
template <class Pair>
PartedPairs parted(const std::vector<Pair>& pairs, const std::vector<int>& inliers) {
  PartedPairs result;
  auto next = inliers.begin();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const bool agrees = next != inliers.end() && *next == int(i);
    if (agrees) ++next;
    (agrees ? result.inliers : result.others).push_back({pairs[i].in_template, pairs[i].in_image});
  }
  return result;
}

}  // namespace kestrel
