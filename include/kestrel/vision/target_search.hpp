#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "kestrel/vision/align.hpp"
#include "kestrel/vision/detector.hpp"
#include "kestrel/vision/frame.hpp"
#include "kestrel/vision/image_pyramid.hpp"
#include "kestrel/vision/self_likeness.hpp"
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

  /// The template near where it was: aligned from the last place or from the expected one,
  /// whichever shows more of it; when that is in doubt, from the likeliest place around, and with
  /// the views that motion blurs. Allocates nothing.
  Sighting follow(const Frame& frame, const Homography& last,
                  const std::optional<Expectation>& expected);

  /// The template in a window, from its keypoints. Of several places that look like the template
  /// the expected one is taken; none, when nothing was expected.
  Sighting detect(const Frame& frame, const PixelBox& window,
                  const std::optional<Expectation>& expected);

  /// An answer that is accepted, but by less of the template than options.weak_share.
  bool is_weak(const Alignment& place) const;

 private:
  /// Where the pixels led from one of the detector's hypotheses.
  struct Place {
    Alignment at;
    int hypothesis = 0;
  };
  struct Choice {
    std::size_t place = 0;
    Miss miss = Miss::None;
  };
  void look(const Frame& frame, const PixelBox& window);
  bool is_told(const Homography& place, const std::optional<Expectation>& expected) const;
  bool is_possible(const Alignment& place, const std::optional<Expectation>& expected) const;
  Choice choose(const std::vector<Place>& places, const std::optional<Expectation>& expected) const;

  /// A place to align a blurred view from.
  struct Guess {
    std::size_t blur = 0;
    Homography start;
    double likeness = 0;
  };
  void follow_blurred(const std::array<Homography, 2>& starts,
                      const std::optional<Expectation>& expected, Sighting& sighting);
  bool is_doubtful(const std::optional<Alignment>& place,
                   const std::optional<Expectation>& expected) const;
  bool may_be_blurred(const std::optional<Alignment>& place,
                      const std::optional<Expectation>& expected) const;
  void settle(const Frame& frame, const std::optional<Expectation>& expected, Sighting& sighting);

  const Template& model_;
  TrackOptions options_;
  SelfLikeness self_;
  AgreementOptions beyond_;  // what is asked where the motion does not tell
  Aligner aligner_;
  std::vector<Aligner> blurred_;  // of model_.blurred(); none for a template that is like itself
  std::vector<Guess> guesses_;
  Detector detector_;
  ImagePyramid pyramid_;
};

}  // namespace kestrel
