#pragma once

#include <memory>

#include "kestrel/vision/frame.hpp"
#include "kestrel/vision/template.hpp"
#include "kestrel/vision/track.hpp"
#include "kestrel/vision/track_options.hpp"

namespace kestrel {

/// Follows one template through frames by one of the methods. What it knows of the past is in the
/// state it is given; it keeps memory, nothing else: the same frame and state give the same answer.
class Tracker {
 public:
  /// Learns the rectangle box of an 8-bit grey image. Throws std::invalid_argument as Template.
  Tracker(const cv::Mat& gray, const PixelBox& box, const TrackOptions& options);
  ~Tracker();
  Tracker(Tracker&&) noexcept;
  Tracker& operator=(Tracker&&) noexcept;

  const Template& model() const;
  const TrackOptions& options() const;

  /// Where the template is in the frame it was learned from; through a lens the nearest homography.
  Homography learned_place() const;

  /// State before the first frame: a window twice the template's size about the place it was
  /// learned at.
  TrackState start(int image_width, int image_height) const;

  /// Looks for the template in one frame. Nothing is allocated while Hybrid follows the pixels.
  Track track(const Frame& frame, const TrackState& state);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace kestrel
