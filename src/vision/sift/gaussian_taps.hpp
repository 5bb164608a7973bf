#pragma once

#include <array>

#include "../kernels/kernels.hpp"

namespace kestrel::sift {

/// A Gaussian blur as one side of a symmetric filter: taps[0] at the centre, taps[i] at i step px.
struct GaussianTaps {
  std::array<float, kernels::kMaxRadius + 1> taps{};
  int radius = 1;
  int step = 1;  // px
};

/// The blur that takes an image of blur sigma_from to blur sigma_to, px, sigma_to > sigma_from > 0.
///
/// An image that is blurred already has nothing left at high frequencies, where a filter with gaps
/// between its taps repeats itself: the steps are as wide as that repetition stays below 1e-4. The
/// variance of the cut filter is that of the Gaussian.
GaussianTaps gaussian_taps(double sigma_from_px, double sigma_to_px);

}  // namespace kestrel::sift
