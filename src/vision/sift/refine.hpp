#pragma once

#include <optional>

#include "octave.hpp"

namespace kestrel::sift {

/// What an extremum must have to be kept (Lowe 2004, section 4).
struct Refinement {
  int layers = 3;
  double contrast = 0;  // smallest |difference of Gaussians|, grey levels
  double edge = 10;     // largest ratio of the principal curvatures
};

/// An extremum of the differences of Gaussians between the pixels and layers.
struct Extremum {
  Candidate at;  // nearest pixel and layer
  float du = 0;  // from there, px of the octave, within half a px
  float dv = 0;
  float dlayer = 0;
  float contrast = 0;  // grey levels, without sign
};

/// The extremum near a candidate by the Taylor series of second order (Lowe 2004, section 4; Brown
/// & Lowe 2002); empty when it runs away or is weak or on an edge.
std::optional<Extremum> refined(const Octave& octave, const Candidate& candidate,
                                const Refinement& wanted);

}  // namespace kestrel::sift
