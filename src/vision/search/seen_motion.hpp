#pragma once

#include <array>
#include <optional>

#include "kestrel/geometry/pixel.hpp"
#include "kestrel/vision/corner_motion.hpp"
#include "kestrel/vision/target_search.hpp"
#include "kestrel/vision/template.hpp"
#include "kestrel/vision/track.hpp"
#include "kestrel/vision/track_options.hpp"

namespace kestrel {

/// The motion of the corners at this time, while it can be believed: for options.coast_s.
std::optional<CornerMotion> motion_at(double stamp_s, const TrackState& state,
                                      const TrackOptions& options);

/// Where the motion leads; empty without one, or when its corners are no view of the template.
std::optional<Expectation> expectation(const std::optional<CornerMotion>& motion,
                                       const Template& model);

/// The motion that led ahead, corrected by the corners seen; one that begins there when nothing led
/// or they are a surprise.
CornerMotion seen_motion(const std::optional<CornerMotion>& ahead,
                         const std::array<Pixel, 4>& corners, const CornerCovariance& covariance,
                         double stamp_s, const MotionOptions& options);

}  // namespace kestrel
