#include "kestrel/lab/pixel_noise.hpp"

#include <cmath>

namespace kestrel {

Pixel PixelNoise::next() {
  if (deviation_px_ == 0) return {};
  constexpr double kTwoPi = 6.283185307179586476925;
  const double radius = std::sqrt(-2 * std::log(1 - unit()));
  const double angle = kTwoPi * unit();
  return {deviation_px_ * radius * std::cos(angle), deviation_px_ * radius * std::sin(angle)};
}

}  // namespace kestrel
