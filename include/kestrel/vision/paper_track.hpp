#pragma once

#include "kestrel/vision/frame.hpp"
#include "kestrel/vision/template.hpp"
#include "kestrel/vision/track.hpp"
#include "kestrel/vision/track_options.hpp"

namespace kestrel {

/// Looks for the template in one frame, inside state.window: the body of the paper's figure 2,
/// every frame from scratch. On success the next window follows the projected centre and size; on
/// failure it doubles. The model must have been learned with TrackMethod::Paper.
Track paper_track(const Template& model, const Frame& frame, const TrackState& state,
                  const TrackOptions& options);

}  // namespace kestrel
