#include "describe.hpp"

#include <algorithm>
#include <cmath>

#include "exact_math.hpp"

namespace kestrel::sift {
namespace {

using kernels::kOrientations;
using Histogram = std::array<float, kOrientations>;

/// The image is blurred by sigma: beyond the half rate of samples sigma apart, pi / sigma, less
/// than 1 % of it is left, and its gradients may be sampled so.
constexpr float kTwoPixelSigma = 2;

/// Gaussian over the samples along a side of the neighbourhood.
struct Window {
  alignas(32) std::array<float, 2 * kernels::kMaxOrientationRadius + 1 + 16> weight{};
};

Window window(float sigma_in_samples, int radius) {
  constexpr std::size_t kCentre = kernels::kMaxOrientationRadius;
  // exp(-(d+1)^2/2s^2) = exp(-d^2/2s^2) q^(2d+1), q = exp(-1/2s^2)
  const float q = float(exponential(-0.5 / (double(sigma_in_samples) * sigma_in_samples)));
  float ratio = q;
  float weight = 1;
  Window result;
  for (std::size_t d = 0; d <= std::size_t(radius); ++d) {
    result.weight[kCentre - d] = weight;
    result.weight[kCentre + d] = weight;
    weight *= ratio;
    ratio *= q * q;
  }
  return result;
}

Histogram histogram(const Octave& octave, const Spot& spot, const kernels::Table& kernels) {
  const int step = spot.sigma < kTwoPixelSigma ? 1 : 2;
  const float sigma = 1.5F * spot.sigma / float(step);
  const int radius =
      std::clamp(int(std::floor(3 * sigma + 0.5F)), 1, kernels::kMaxOrientationRadius);
  const Window weights = window(sigma, radius);
  const int u = int(std::floor(spot.u + 0.5F));
  const int v = int(std::floor(spot.v + 0.5F));
  const Plane<std::int16_t>& plane = octave.level(spot.layer);
  Histogram result;
  kernels::OrientationPatch patch{};
  patch.centre = plane.row(v) + u;
  patch.stride = plane.stride();
  patch.radius = radius;
  patch.step = step;
  patch.left = (u - 1) / step;
  patch.right = (octave.width() - 2 - u) / step;
  patch.above = (v - 1) / step;
  patch.below = (octave.height() - 2 - v) / step;
  patch.weight = weights.weight.data();
  patch.histogram = result.data();
  kernels.orientations(patch);
  return result;
}

/// With the binomial filter 1 4 6 4 1.
Histogram smoothed(const Histogram& h) {
  std::array<float, kOrientations + 4> around;  // two bins more at each end
  std::copy(h.begin(), h.end(), around.begin() + 2);
  std::copy(h.end() - 2, h.end(), around.begin());
  std::copy(h.begin(), h.begin() + 2, around.end() - 2);
  Histogram result;
  for (std::size_t b = 0; b < kOrientations; ++b) {
    result[b] = (around[b] + around[b + 4]) * (1.F / 16) +
                (around[b + 1] + around[b + 3]) * (4.F / 16) + around[b + 2] * (6.F / 16);
  }
  return result;
}

}  // namespace

void prefetch(const Octave& octave, const Spot& spot) {
  constexpr int kLine = 32;                               // numbers of 16 bits
  const int reach = int(8.5F * 3 * 5 / 16 * spot.sigma);  // of the grid when it is not turned
  const Plane<std::int16_t>& plane = octave.level(spot.layer);
  const int first = std::max(int(spot.v) - reach, 0);
  const int last = std::min(int(spot.v) + reach, octave.height() - 1);
  const int left = std::max(int(spot.u) - reach, 0);
  const int right = std::min(int(spot.u) + reach, octave.width() - 1);
  for (int v = first; v <= last; ++v)
    for (int u = left; u <= right + kLine - 1; u += kLine) __builtin_prefetch(plane.row(v) + u);
}

Peaks orientations(const Octave& octave, const Spot& spot, const kernels::Table& kernels) {
  constexpr float kRadPerBin = 6.283185307F / kOrientations;
  const Histogram h = smoothed(histogram(octave, spot, kernels));
  const float enough = 0.8F * *std::max_element(h.begin(), h.end());
  Peaks peaks;
  for (int b = 0; b < kOrientations; ++b) {
    const float at = h[std::size_t(b)];
    if (at < enough) continue;
    const float before = h[std::size_t((b + kOrientations - 1) % kOrientations)];
    const float after = h[std::size_t((b + 1) % kOrientations)];
    if (!(at > before && at > after)) continue;
    float bin = float(b) + 0.5F * (before - after) / (before - 2 * at + after);
    if (bin < 0) bin += kOrientations;
    if (bin >= kOrientations) bin -= kOrientations;
    peaks.angle[std::size_t(peaks.count++)] = bin * kRadPerBin;
  }
  return peaks;
}

kernels::DescriptorGrid descriptor_grid() {
  constexpr double kCellsPerSample = 5. / 16;
  kernels::DescriptorGrid grid{};
  for (int k = 0; k < kernels::kGridSide * kernels::kGridSide; ++k) {
    const int row = k / kernels::kGridSide;
    grid.across[k] = float(k - row * kernels::kGridSide) - 8.5F;
    grid.down[k] = float(row) - 8.5F;
  }
  for (int k = 0; k < 256; ++k) {
    const int row = k / 16;
    const double across = (k - 16 * row - 7.5) * kCellsPerSample;
    const double down = (row - 7.5) * kCellsPerSample;
    grid.window[k] = float(exponential(-(across * across + down * down) / 8));
  }
  return grid;
}

Descriptor described(const Octave& octave, const Spot& spot, float angle_rad,
                     const kernels::DescriptorGrid& grid, const kernels::Table& kernels) {
  constexpr double kSigmasPerSample = 3 * 5. / 16;
  const Direction along = direction(double(angle_rad));
  const Plane<std::int16_t>& plane = octave.level(spot.layer);
  Descriptor result;
  kernels::DescriptorPatch patch{};
  patch.grid = &grid;
  patch.image = plane.row(0);
  patch.stride = plane.stride();
  patch.width = octave.width();
  patch.height = octave.height();
  patch.u = spot.u;
  patch.v = spot.v;
  patch.step_u = float(along.cosine * kSigmasPerSample * double(spot.sigma));
  patch.step_v = float(along.sine * kSigmasPerSample * double(spot.sigma));
  patch.bins = result.bin.data();
  kernels.describe(patch);
  return result;
}

}  // namespace kestrel::sift
