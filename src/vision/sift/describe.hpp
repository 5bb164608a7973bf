#pragma once

#include <array>

#include "kestrel/vision/sift.hpp"

#include "../kernels/kernels.hpp"
#include "octave.hpp"

namespace kestrel::sift {

/// A place in an octave whose neighbourhood is looked at.
struct Spot {
  int layer = 0;
  float u = 0;      // px of the octave
  float v = 0;      // px of the octave
  float sigma = 0;  // px of the octave
};

/// Asks for the neighbourhood of a spot that will be looked at soon.
void prefetch(const Octave& octave, const Spot& spot);

/// Dominant orientations of a neighbourhood, rad from u towards v in [0, 2 pi).
struct Peaks {
  std::array<float, kernels::kOrientations / 2> angle{};
  int count = 0;
};

/// Peaks of at least 0.8 of the highest in the histogram of gradient orientations, weighted by a
/// Gaussian of 1.5 sigma (Lowe 2004, section 5). None where the image is flat.
Peaks orientations(const Octave& octave, const Spot& spot, const kernels::Table& kernels);

/// The samples of every descriptor: 16x16 over five cells of three sigma, weighted by a Gaussian of
/// two cells (Lowe 2004, section 6.1; the half cell around the 4x4 is what its interpolation
/// reaches).
kernels::DescriptorGrid descriptor_grid();

/// What the neighbourhood looks like from an orientation, rad.
Descriptor described(const Octave& octave, const Spot& spot, float angle_rad,
                     const kernels::DescriptorGrid& grid, const kernels::Table& kernels);

}  // namespace kestrel::sift
