#pragma once

#include <optional>

#include "kestrel/vision/align.hpp"
#include "kestrel/vision/self_likeness.hpp"
#include "kestrel/vision/target_search.hpp"
#include "kestrel/vision/template.hpp"
#include "kestrel/vision/track_options.hpp"

namespace kestrel {

/// The alignment's options, with the instruction set that is asked for everything.
AlignOptions align_options(const TrackOptions& options);

/// What is asked of a place before it counts as the template's, and before no better one is looked
/// for.
class Verdict {
 public:
  /// The model must outlive it. Looks for the places at which the template is like itself.
  Verdict(const Template& model, const TrackOptions& options);

  const SelfLikeness& self() const { return self_; }

  /// True where the image shows the template. Of one that is like itself more is asked, lest
  /// another part of it is taken for it, unless the motion rules those places out.
  bool is_possible(const Alignment& place, const std::optional<Expectation>& expected) const;

  /// True when less than options.weak_share of the template is alike.
  bool is_weak(const Alignment& place) const;

  /// True when the place may be none of the template, or not the best one.
  bool is_doubtful(const std::optional<Alignment>& place,
                   const std::optional<Expectation>& expected) const;

  /// True when so little is alike that another place where the template is like itself may be as
  /// good.
  bool may_be_another(const Alignment& place) const;

  /// True where the image shows as much of the template as a sharp one would.
  bool is_sharp(const Alignment& place) const;

  /// True for a doubtful place that shows nothing of the template sharp.
  bool may_be_blurred(const std::optional<Alignment>& place,
                      const std::optional<Expectation>& expected) const;

  /// True when a blurred view is shown by so much that chance does not explain it. Its blocks are
  /// smooth, each is one ramp or two, and the eight parameters of an alignment can lay several such
  /// ramps over those of any smooth picture.
  static bool is_evident_blurred(const Alignment& place);

  /// Standard deviations within which a place is the expected one.
  static constexpr double kGate = 3;

 private:
  bool is_told(const Homography& place, const std::optional<Expectation>& expected) const;

  const Template& model_;
  TrackOptions options_;
  SelfLikeness self_;
  AgreementOptions beyond_;  // what is asked where the motion does not tell
};

}  // namespace kestrel
