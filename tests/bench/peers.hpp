#pragma once

#include <vector>

#include "kestrel/eval/bench.hpp"

/// Other ways to track a plane, as their libraries offer them, to be compared with. Each is given
/// one thread and the outline test of kestrel (is_plausible), because a user would add one.
namespace kestrel::test {

/// Keypoints + matching + cv::findHomography, in the paper's window or the whole frame.
/// cv::SIFT's bias of 0.25 px is taken off.
std::vector<BenchMethod> opencv_peers();

/// vpKeyPoint + vpHomography::ransac as in ViSP's tutorial of planar localisation, and the template
/// trackers SSD inverse compositional (homography) and ESM (SL3) on two pyramid levels. The latter
/// never say that they lost the template; an exception counts as not found, for ever after.
std::vector<BenchMethod> visp_peers();

}  // namespace kestrel::test
