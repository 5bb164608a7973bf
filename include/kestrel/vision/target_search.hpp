#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "kestrel/vision/align.hpp"
#include "kestrel/vision/frame.hpp"
#include "kestrel/vision/template.hpp"
#include "kestrel/vision/track.hpp"
#include "kestrel/vision/track_options.hpp"

namespace kestrel {

/// Where one search saw the target, and what it looked at.
struct Sighting {
  std::optional<Alignment> at;  // the best place; see is_accepted there
  TrackStage stage = TrackStage::None;
  Miss miss = Miss::NotAlike;  // None when the place is accepted
  PixelBox window;             // px
  int keypoints = 0;
  int matches = 0;
  std::vector<PixelPair> inliers;
  std::vector<PixelPair> others;  // matches that are no inliers

  bool is_accepted() const { return miss == Miss::None; }
};

/// Where the target is expected: place in the image, and how far off that may be.
struct Expectation {
  Homography image_from_template;
  double deviation_px = 0;
};

/// The two ways to find a template in a frame: from where it was, and from keypoints. Both end with
/// the pixels, which accept or refuse. Keeps its memory from frame to frame.
class TargetSearch {
 public:
  /// The model must have been learned with these options and outlive the search.
  TargetSearch(const Template& model, const TrackOptions& options);
  ~TargetSearch();
  TargetSearch(TargetSearch&&) noexcept;
  TargetSearch& operator=(TargetSearch&&) noexcept;

  /// The template near where it was: aligned from the last place or from the expected one,
  /// whichever shows more of it; when that is in doubt, from the likeliest place around, and with
  /// the views that motion blurs. Allocates nothing.
  Sighting follow(const Frame& frame, const Homography& last,
                  const std::optional<Expectation>& expected);

  /// The template in a window, from its keypoints: of the usual structures, and where they find no
  /// place, of small ones, if Detector has a second look. Of several places that look like the
  /// template the expected one is taken; none, when nothing was expected.
  Sighting detect(const Frame& frame, const PixelBox& window,
                  const std::optional<Expectation>& expected);

  /// An answer that is accepted, but by less of the template than options.weak_share.
  bool is_weak(const Alignment& place) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace kestrel
