#pragma once

#include <vector>

#include "bundle.hpp"

namespace kestrel {

/// Where the least squares may begin, the best first: what OpenCV finds, and for a fisheye also
/// plain guesses of the focal length, since OpenCV's fisheye solver gives up on views that are no
/// worse than others. Empty when there is none.
std::vector<BundleState> camera_starts(const BundleProblem& problem);

}  // namespace kestrel
