#pragma once

#include <cstdint>
#include <random>

#include "kestrel/geometry/pixel.hpp"

namespace kestrel {

/// Gaussian noise of a pixel, pair after pair of one stream: std::mt19937_64, U = (x >> 11) 2^-53,
/// Box & Muller: (cos, sin)(2 pi U2) sqrt(-2 ln(1 - U1)). Written out because std's distributions
/// differ between libraries.
class PixelNoise {
 public:
  PixelNoise(std::uint64_t seed, double deviation_px)
      : engine_(seed), deviation_px_(deviation_px) {}

  /// The next pair, px; zero without a draw when the deviation is zero.
  Pixel next();

 private:
  double unit() { return double(engine_() >> 11) * 0x1p-53; }

  std::mt19937_64 engine_;
  double deviation_px_;
};

}  // namespace kestrel
