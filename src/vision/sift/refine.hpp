#pragma once

#include <cstdint>
#include <optional>

#include "plane.hpp"

namespace kestrel::sift {

/// A pixel of a difference of Gaussians that is extreme among its neighbours.
struct Candidate {
  int layer = 0;
  int u = 0;  // px of the octave
  int v = 0;
};

/// The levels of blur of an octave, in units of 1/kFixedScale grey levels.
struct Levels {
  const Plane<std::int16_t>* planes = nullptr;  // layers + 3
  int width = 0;
  int height = 0;
  int layers = 3;
};

/// What an extremum must have to be kept (Lowe 2004, section 4).
struct Refinement {
  double contrast = 0;  // smallest |difference of Gaussians|, grey levels
  double edge = 10;     // largest ratio of the principal curvatures
};

/// An extremum of the differences of Gaussians between the pixels and layers.
struct Extremum {
  Candidate at;  // nearest pixel and layer
  float du = 0;  // from there, px of the octave, within 0.6 px
  float dv = 0;
  float dlayer = 0;
  float contrast = 0;  // grey levels, without sign
};

/// Extrema are looked for this far from the border.
constexpr int kBorderPx = 5;

/// An extremum lies so near its candidate; rows this far above and below the candidate are read.
constexpr int kRefineMovePx = 2;
constexpr int kRefineReachPx = kRefineMovePx + 1;

/// The extremum near a candidate by the Taylor series of second order (Lowe 2004, section 4; Brown
/// & Lowe 2002); empty when it runs away or is weak or on an edge.
std::optional<Extremum> refined(const Levels& levels, const Candidate& candidate,
                                const Refinement& wanted);

}  // namespace kestrel::sift
