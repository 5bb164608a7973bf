#pragma once

#include <vector>

#include "kestrel/geometry/homography.hpp"

#include "support/random.hpp"

namespace kestrel::test {

/// The template that grid() lies on, px.
inline constexpr double kGridWidth = 160;
inline constexpr double kGridHeight = 120;

/// Thirty exact pairs, 6 x 5, over this part (0 to 1) of each side of the template.
inline std::vector<PixelPair> grid(const Homography& H, double from, double to) {
  std::vector<PixelPair> pairs;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 5; ++j) {
      const Pixel p{(from + (to - from) * i / 5) * kGridWidth,
                    (from + (to - from) * j / 4) * kGridHeight};
      pairs.push_back({p, H * p});
    }
  }
  return pairs;
}

/// The pairs with normal noise of each coordinate in the image.
inline std::vector<PixelPair> noisy(std::vector<PixelPair> pairs, double sigma_px, Random& random) {
  for (PixelPair& pair : pairs) {
    pair.in_image.u += sigma_px * random.normal();
    pair.in_image.v += sigma_px * random.normal();
  }
  return pairs;
}

}  // namespace kestrel::test
