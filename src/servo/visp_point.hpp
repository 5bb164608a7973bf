#pragma once

#include <visp3/visual_features/vpFeaturePoint.h>

#include "kestrel/servo/feature.hpp"

#ifdef ENABLE_VISP_NAMESPACE
using namespace VISP_NAMESPACE_NAME;  // NOLINT(google-build-using-namespace): ViSP after 3.6
#endif

namespace kestrel {

/// Depth below which vpFeaturePoint prints and throws, m.
inline constexpr double kSmallestDepthM = 1e-6;

/// True when vpFeaturePoint takes all of them: finite, and in front of the camera.
bool are_usable(const std::vector<Feature>& features);

/// The feature in ViSP's form; only for usable features.
vpFeaturePoint visp_point(const Feature& feature);

}  // namespace kestrel
