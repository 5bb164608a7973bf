#pragma once

#include <optional>
#include <vector>

#include "kestrel/geometry/homography.hpp"
#include "kestrel/vision/frame.hpp"
#include "kestrel/vision/keypoints.hpp"
#include "kestrel/vision/match.hpp"
#include "kestrel/vision/robust_homography.hpp"
#include "kestrel/vision/template.hpp"

namespace kestrel {

/// All parameters of the tracker of the paper's figure 2.
struct TrackOptions {
  SiftOptions sift;
  MatchOptions match;
  RansacOptions ransac;
  OutlineOptions outline;
  double max_outline_deviation_px = 3;  // so that an outline 10 px off is a three-sigma event

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// What the tracker carries from one frame to the next.
struct TrackState {
  PixelBox window;  // where to look next
};

/// Why a frame gave no answer.
enum class Miss {
  None,          // the object was found
  NoImage,       // the frame is empty, or not 8-bit grey
  FewKeypoints,  // too little texture in the window
  FewMatches,    // fewer matches than the consensus asks for
  NoConsensus,   // RANSAC ended without consensus
  BadOutline,    // the homography is no possible view of the template
  Undetermined,  // the inliers leave the outline too uncertain
};

/// What was seen in one frame.
struct Track {
  std::optional<Homography> image_from_template;  // only when found
  Miss miss = Miss::None;
  PixelBox window;  // where it looked, px
  int keypoints = 0;
  int matches = 0;
  int trials = 0;
  std::vector<PixelPair> inliers;
  TrackState next;

  bool found() const { return image_from_template.has_value(); }
};

/// State before the first frame: window twice the template's size about the place it was learned
/// at.
TrackState start_tracking(const Template& model, int image_width, int image_height);

/// Looks for the template in one frame, inside state.window: the body of the paper's figure 2. On
/// success the next window follows the projected centre and size; on failure it doubles.
Track track(const Template& model, const Frame& frame, const TrackState& state,
            const TrackOptions& options);

/// One word for a log: "found", "few_keypoints", ...
const char* name(Miss miss);

}  // namespace kestrel
