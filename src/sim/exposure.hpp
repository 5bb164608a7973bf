#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "random.hpp"

namespace kestrel::sim_detail {

/// As many as twelve bits choose between.
constexpr int kQuantiles = 4096;

/// Quantiles of the standard normal at the centres of n equal shares of probability.
inline std::vector<float> normal_quantiles(int n = kQuantiles) {
  std::vector<float> quantiles;
  quantiles.reserve(std::size_t(n));
  double x = -4;
  for (int i = 0; i < n; ++i) {
    const double p = (i + 0.5) / n;
    for (int k = 0; k < 20; ++k) {  // Newton from the left, where the distribution is convex
      const double density = std::exp(-x * x / 2) / std::sqrt(2 * M_PI);
      x += (p - std::erfc(-x / std::sqrt(2.0)) / 2) / density;
    }
    quantiles.push_back(float(x));
  }
  return quantiles;
}

/// Adds noise and rounds. The stream is the row's own, so rows may be made in any order.
inline void expose_row(const std::vector<float>& light, int width, std::uint8_t* grey,
                       float noise_grey, const std::vector<float>& quantiles, std::uint64_t seed) {
  RandomStream random(seed);
  std::uint64_t bits = 0;
  for (int u = 0; u < width; ++u) {
    float value = light[std::size_t(u)];
    if (noise_grey > 0) {
      bits = u % 5 == 0 ? random.bits() : bits >> 12;  // twelve bits a pixel
      value += noise_grey * quantiles[bits % kQuantiles];
    }
    grey[u] = std::uint8_t(std::clamp(value + 0.5f, 0.f, 255.f));
  }
}

}  // namespace kestrel::sim_detail
