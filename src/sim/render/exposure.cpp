#include "exposure.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "../random.hpp"

namespace kestrel::sim_detail {
namespace {

using Quantiles = std::array<float, kQuantiles>;

/// Quantiles of the standard normal at the centres of equal shares of probability.
Quantiles normal_quantiles() {
  Quantiles quantiles;
  double x = -4;
  for (std::size_t i = 0; i < quantiles.size(); ++i) {
    const double p = (double(i) + 0.5) / double(kQuantiles);
    for (int k = 0; k < 20; ++k) {  // Newton from the left, where the distribution is convex
      const double density = std::exp(-x * x / 2) / std::sqrt(2 * M_PI);
      x += (p - std::erfc(-x / std::sqrt(2.0)) / 2) / density;
    }
    quantiles[i] = float(x);
  }
  return quantiles;
}

const Quantiles& quantiles() {
  static const Quantiles table = normal_quantiles();
  return table;
}

}  // namespace

Exposure::Exposure(cv::Size picture, const RenderOptions& options, Sense sense) : sense_(sense) {
  sensor_.centre_u = float(picture.width - 1) / 2;
  sensor_.centre_v = float(picture.height - 1) / 2;
  const float corner = sensor_.centre_u * sensor_.centre_u + sensor_.centre_v * sensor_.centre_v;
  sensor_.gain = float(options.gain);
  sensor_.loss = float(options.gain * options.vignetting) / std::max(1.f, corner);
  sensor_.noise_grey = float(options.noise_grey);
  sensor_.quantiles = quantiles().data();
  const std::uint64_t seed = derived_seed(options.seed, std::uint64_t(options.frame));
  sensor_.seed_low = std::uint32_t(seed);
  sensor_.seed_high = std::uint32_t(seed >> 32);
}

void Exposure::expose(const TileLight& light, std::size_t views, const Tile& tile,
                      cv::Mat& picture) const {
  Sensor sensor = sensor_;
  sensor.gain /= float(views);
  sensor.loss /= float(views);
  std::uint8_t* const corner = picture.ptr(tile.v) + tile.u;
  const int count = picture.cols - tile.u;
  if (count >= kRun) {
    return sense_(sensor, light.data(),
                  {tile.u, tile.v, tile.rows, corner, std::ptrdiff_t(picture.step[0])});
  }
  std::array<std::uint8_t, kTilePixels> grey;
  sense_(sensor, light.data(), {tile.u, tile.v, tile.rows, grey.data(), kRun});
  for (int row = 0; row < tile.rows; ++row) {
    std::copy_n(&grey[begin_of_row(row)], count, picture.ptr(tile.v + row) + tile.u);
  }
}

}  // namespace kestrel::sim_detail
