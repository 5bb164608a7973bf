#include "gaussian_taps.hpp"

#include <algorithm>
#include <cmath>

#include "exact_math.hpp"

namespace kestrel::sift {
namespace {

constexpr double kTwoPi = 6.283185307179586;

/// Taps on each side, in standard deviations: what is cut off is 0.4 % of the weight.
constexpr double kReach = 2.9;

/// A filter of variance d^2 with taps n apart repeats its response at 2 pi / n; on an image of
/// variance s^2 the product of both is at most exp(-(2 pi / n)^2 h^2 / 2), 1 / h^2 = 1/s^2 + 1/d^2.
/// n = 2 pi h / 4.29 makes that 1e-4.
int widest_step(double from_px, double added_px) {
  const double h = from_px * added_px / std::sqrt(from_px * from_px + added_px * added_px);
  return std::clamp(int(kTwoPi * h / 4.29), 1, kernels::kMaxStep);
}

using Weights = std::array<double, kernels::kMaxRadius + 1>;

Weights weights(double sigma, int radius) {
  Weights w{};
  double sum = 0;
  for (int i = 0; i <= radius; ++i) {
    w[std::size_t(i)] = exponential(-0.5 * i * i / (sigma * sigma));
    sum += (i == 0 ? 1 : 2) * w[std::size_t(i)];
  }
  for (double& x : w) x /= sum;
  return w;
}

double variance(const Weights& w) {
  double sum = 0;
  for (std::size_t i = 1; i < w.size(); ++i) sum += 2 * double(i * i) * w[i];
  return sum;
}

}  // namespace

GaussianTaps gaussian_taps(double sigma_from_px, double sigma_to_px) {
  const double added = std::sqrt(sigma_to_px * sigma_to_px - sigma_from_px * sigma_from_px);
  GaussianTaps result;
  result.step = widest_step(sigma_from_px, added);
  const double sigma = added / result.step;
  result.radius = std::clamp(int(std::ceil(kReach * sigma)), 1, kernels::kMaxRadius);
  // The Gaussian whose cut filter has the variance wanted: it grows with sigma.
  double low = sigma / 2;
  double high = sigma * 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (variance(weights(middle, result.radius)) < sigma * sigma ? low : high) = middle;
  }
  const Weights w = weights(high, result.radius);
  std::transform(w.begin(), w.end(), result.taps.begin(), [](double x) { return float(x); });
  return result;
}

}  // namespace kestrel::sift
