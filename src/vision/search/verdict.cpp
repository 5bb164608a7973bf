#include "verdict.hpp"

#include <algorithm>

#include <Eigen/LU>

#include "places.hpp"

namespace kestrel {
namespace {

/// A better half that correlates above this, nine tenths of its variance explained, is sharp: more
/// is to be gained by less noise, not by less blur.
constexpr double kSharpHalf = 0.95;

/// And above this, four fifths explained, what is doubtful for its other half is covered there.
constexpr double kCoveredHalf = 0.9;

/// The template's own picture has no lens before it.
AlignOptions options_without_lens(const TrackOptions& options) {
  AlignOptions align = align_options(options);
  align.lens.reset();
  return align;
}

/// Of a blurred view twice as many blocks must be alike as are not.
constexpr double kEvidentShare = 2.0 / 3;

}  // namespace

AlignOptions align_options(const TrackOptions& options) {
  AlignOptions align = options.align;
  align.simd = options.simd;
  align.lens = options.lens;
  return align;
}

Verdict::Verdict(const Template& model, const TrackOptions& options)
    : model_(model),
      options_(options),
      self_(self_likeness(model.picture(), model.blocks(), options_without_lens(options))),
      beyond_(beyond_self_likeness(options.align.agreement, self_.share)) {}

/// True where the motion leads to the place and to none at which the template is like this one.
bool Verdict::is_told(const Homography& place, const std::optional<Expectation>& expected) const {
  if (!expected) return false;
  const double gate_px = kGate * expected->deviation_px;
  const auto is_expected = [&](const Eigen::Matrix3d& H) {
    return apart(Homography{H}, expected->image_from_template, model_) <= gate_px;
  };
  return is_expected(place.H) &&
         std::none_of(self_.places.begin(), self_.places.end(), [&](const Homography& like) {
           return is_expected(place.H * like.H) || is_expected(place.H * like.H.inverse());
         });
}

bool Verdict::is_possible(const Alignment& place,
                          const std::optional<Expectation>& expected) const {
  return place.is_accepted &&
         (kestrel::is_accepted(place.agreement, beyond_) ||
          is_told(place.image_from_template, expected)) &&
         is_plausible(place.image_from_template, model_.width(), model_.height(), options_.outline);
}

bool Verdict::is_weak(const Alignment& place) const {
  return place.agreement.alike_share() < options_.weak_share;
}

bool Verdict::is_doubtful(const std::optional<Alignment>& place,
                          const std::optional<Expectation>& expected) const {
  return !place || !is_possible(*place, expected) || is_weak(*place) || may_be_another(*place);
}

/// So much of it may show a line of print, or a window, beside the place.
bool Verdict::may_be_another(const Alignment& place) const {
  return !self_.places.empty() && place.agreement.alike_share() < sure_share(self_.share);
}

bool Verdict::is_sharp(const Alignment& place) const {
  return place.agreement.better_half() > kSharpHalf;
}

bool Verdict::is_evident_blurred(const Alignment& place) {
  return place.agreement.alike_share() >= kEvidentShare;
}

/// What is covered leaves the better half of the blocks as it is, what is blurred spoils all.
bool Verdict::may_be_blurred(const std::optional<Alignment>& place,
                             const std::optional<Expectation>& expected) const {
  return is_doubtful(place, expected) &&
         !(place && is_possible(*place, expected) && place->agreement.better_half() > kCoveredHalf);
}

}  // namespace kestrel
