#pragma once

#include <cstdint>
#include <optional>

#include "kestrel/geometry/pixel.hpp"
#include "kestrel/vision/corner_motion.hpp"
#include "kestrel/vision/frame.hpp"
#include "kestrel/vision/track.hpp"
#include "kestrel/vision/track_options.hpp"

namespace kestrel {

double area_px2(const PixelBox& box);

/// Where a frame is searched for keypoints first, by the policy: where the motion leads, or the
/// target was last seen; learned_at is the template's rectangle. Kalman's lies in the frame.
PixelBox keypoint_window(const Frame& frame, const TrackState& state,
                         const std::optional<CornerMotion>& motion, const PixelBox& learned_at,
                         WindowPolicy policy);

/// The part of the frame whose turn it is: strips of so many pixels that overlap by a third.
PixelBox strip(const Frame& frame, double most_px, std::int64_t turn);

}  // namespace kestrel
