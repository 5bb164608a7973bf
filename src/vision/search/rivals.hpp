#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "kestrel/vision/align.hpp"
#include "kestrel/vision/image_pyramid.hpp"
#include "kestrel/vision/target_search.hpp"
#include "kestrel/vision/template.hpp"
#include "kestrel/vision/track.hpp"

#include "verdict.hpp"

namespace kestrel {

/// Where the pixels led from one of the detector's hypotheses.
struct Place {
  Alignment at;
  int hypothesis = 0;
};

/// Which place is taken, and why none.
struct Choice {
  std::size_t place = 0;
  Miss miss = Miss::None;
};

/// Of places, best first and at least one, the best; of several as good the one where the template
/// is expected, and none when nothing was expected.
Choice choice(const std::vector<Place>& places, const std::optional<Expectation>& expected,
              const Verdict& verdict, const Template& model);

/// The place that is left, and why it is none.
struct Settled {
  Alignment at;
  Miss miss = Miss::None;
};

/// A place held against those at which the template is like this one: the best of them all is
/// taken, and none when two are as good. `image` is the whole frame.
Settled settled(const Alignment& found, Aligner& aligner, const ImagePyramid& image,
                const std::optional<Expectation>& expected, const Verdict& verdict,
                const Template& model);

}  // namespace kestrel
