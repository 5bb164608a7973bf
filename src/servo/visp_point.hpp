#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <visp3/visual_features/vpFeaturePoint.h>

#include "kestrel/servo/feature.hpp"

#ifdef ENABLE_VISP_NAMESPACE
using namespace VISP_NAMESPACE_NAME;  // NOLINT(google-build-using-namespace): ViSP after 3.6
#endif

namespace kestrel {

/// Depth below which vpFeaturePoint prints and throws, m.
inline constexpr double kSmallestDepth = 1e-6;
/// No coordinate, depth (m) or lever arm (m) of a camera is larger; products of such numbers stay
/// far from an overflow, about which LAPACK would print.
inline constexpr double kLargest = 1e6;

/// True when ViSP takes all of them in silence: finite, and in front of the camera.
inline bool are_usable(const std::vector<Feature>& features) {
  return std::all_of(features.begin(), features.end(), [](const Feature& f) {
    return std::abs(f.at.x) <= kLargest && std::abs(f.at.y) <= kLargest &&
           f.depth_m >= kSmallestDepth && f.depth_m <= kLargest;
  });
}

/// The feature in ViSP's form; only for usable features.
inline vpFeaturePoint visp_point(const Feature& feature) {
  vpFeaturePoint point;
  point.buildFrom(feature.at.x, feature.at.y, feature.depth_m);
  return point;
}

}  // namespace kestrel
