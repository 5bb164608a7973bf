#include "kestrel/vision/target_search.hpp"

#include <algorithm>
#include <array>

#include <Eigen/LU>

namespace kestrel {
namespace {

/// The pyramid reaches this far beyond the outline, as a share of its size and at least so many px:
/// room for the alignment to move.
constexpr double kMarginShare = 0.15;
constexpr double kMarginPx = 16;

/// Places less than this apart, as a share of the outline's size, are one place.
constexpr double kSamePlaceShare = 0.05;

/// A rival that shows this share of what the best place shows is as good as that.
constexpr double kRivalShare = 0.8;

/// A better half that correlates above this, four fifths of its variance explained, is seen sharp.
constexpr double kSharpHalf = 0.9;

/// Views under motion blur that are aligned in one frame: of those 30 degrees or a factor of 1.5
/// apart four are next to each other, from two starts.
constexpr std::size_t kTriedBlurs = 8;

/// Standard deviations within which a place is the expected one.
constexpr double kGate = 3;

AlignOptions align_options(const TrackOptions& options) {
  AlignOptions align = options.align;
  align.simd = options.simd;
  return align;
}

PixelBox box_of(const Homography& H, const Template& model) {
  const auto c = outline(H, model.width(), model.height());
  const auto [left, right] = std::minmax({c[0].u, c[1].u, c[2].u, c[3].u});
  const auto [top, bottom] = std::minmax({c[0].v, c[1].v, c[2].v, c[3].v});
  return {left, top, right - left, bottom - top};
}

PixelBox with_margin(const PixelBox& box) {
  const double by = kMarginPx + kMarginShare * std::max(box.width, box.height);
  return {box.u - by, box.v - by, box.width + 2 * by, box.height + 2 * by};
}

PixelBox united(const PixelBox& a, const PixelBox& b) {
  const double left = std::min(a.u, b.u);
  const double top = std::min(a.v, b.v);
  return {left, top, std::max(a.u + a.width, b.u + b.width) - left,
          std::max(a.v + a.height, b.v + b.height) - top};
}

/// Mean distance of the corners at two places, px.
double apart(const Homography& a, const Homography& b, const Template& model) {
  const auto at = outline(a, model.width(), model.height());
  const auto to = outline(b, model.width(), model.height());
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) sum += distance(at[i], to[i]);
  return sum / 4;
}

bool is_same(const Homography& a, const Homography& b, const Template& model) {
  const PixelBox box = box_of(a, model);
  return apart(a, b, model) <= kSamePlaceShare * std::max(box.width, box.height);
}

bool is_better(const Alignment& a, const Alignment& b) {
  return a.is_accepted != b.is_accepted ? a.is_accepted : a.agreement.shown() > b.agreement.shown();
}

/// The pairs of keypoints that led to a place.
std::vector<PixelPair> pairs_of(const Detection& seen, int hypothesis) {
  std::vector<PixelPair> pairs;
  for (const int i : seen.hypotheses[std::size_t(hypothesis)].inliers) {
    const AffinePair& pair = seen.pairs[std::size_t(i)];
    pairs.push_back({pair.in_template, pair.in_image});
  }
  return pairs;
}

}  // namespace

TargetSearch::TargetSearch(const Template& model, const TrackOptions& options)
    : model_(model),
      options_(options),
      self_(self_likeness(model.picture(), model.blocks(), align_options(options))),
      beyond_(beyond_self_likeness(options.align.agreement, self_.share)),
      aligner_(model.blocks(), align_options(options)),
      detector_(model, options) {
  // Blurred, a picture that is like itself is so even more: any of those places would do.
  if (!self_.places.empty()) return;
  for (const TemplateBlocks& blocks : model.blurred()) {
    blurred_.emplace_back(blocks, align_options(options));
  }
  guesses_.reserve(2 * blurred_.size());
}

void TargetSearch::look(const Frame& frame, const PixelBox& window) {
  pyramid_.look(frame.gray, window, aligner_.levels(), options_.simd);
}

/// True where the motion leads to the place and to none at which the template is like this one.
bool TargetSearch::is_told(const Homography& place,
                           const std::optional<Expectation>& expected) const {
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

/// Of a template that is like itself more is asked, lest another part of it is taken for it, unless
/// the motion rules those places out.
bool TargetSearch::is_possible(const Alignment& place,
                               const std::optional<Expectation>& expected) const {
  return place.is_accepted &&
         (kestrel::is_accepted(place.agreement, beyond_) ||
          is_told(place.image_from_template, expected)) &&
         is_plausible(place.image_from_template, model_.width(), model_.height(), options_.outline);
}

bool TargetSearch::is_weak(const Alignment& place) const {
  return place.agreement.alike_share() < options_.weak_share;
}

Sighting TargetSearch::follow(const Frame& frame, const Homography& last,
                              const std::optional<Expectation>& expected) {
  const Homography& ahead = expected ? expected->image_from_template : last;
  Sighting result;
  result.stage = TrackStage::Aligned;
  result.window = clipped(with_margin(united(box_of(last, model_), box_of(ahead, model_))),
                          frame.gray.cols, frame.gray.rows);
  look(frame, result.window);
  const bool moves = aligner_.likeness(pyramid_, ahead) >= aligner_.likeness(pyramid_, last);
  const Homography& start = moves ? ahead : last;
  result.at = aligner_.align(pyramid_, start);
  if (is_doubtful(result.at, expected)) {
    result.window = {0, 0, double(frame.gray.cols), double(frame.gray.rows)};
    look(frame, result.window);
    const Homography around = aligner_.search(pyramid_, start);
    const auto improve_from = [&](const Homography& from, TrackStage stage) {
      const auto at = aligner_.align(pyramid_, from);
      if (!at || (result.at && !is_better(*at, *result.at))) return;
      result.at = at;
      result.stage = stage;
    };
    // The steps may have run out: they go on.
    if (result.at) improve_from(Homography(result.at->image_from_template), TrackStage::Aligned);
    improve_from(around, TrackStage::Searched);
    if (may_be_blurred(result.at, expected)) {
      follow_blurred({around, result.at ? result.at->image_from_template : start}, expected,
                     result);
    }
  }
  if (result.at && is_possible(*result.at, expected)) result.miss = Miss::None;
  settle(frame, expected, result);
  return result;
}

bool TargetSearch::is_doubtful(const std::optional<Alignment>& place,
                               const std::optional<Expectation>& expected) const {
  if (!place || !is_possible(*place, expected) || is_weak(*place)) return true;
  // So much of it may show a line of print, or a window, beside the place.
  return !self_.places.empty() && place->agreement.alike_share() < sure_share(self_.share);
}

/// What is covered leaves the better half of the blocks as it is, what is blurred spoils all.
bool TargetSearch::may_be_blurred(const std::optional<Alignment>& place,
                                  const std::optional<Expectation>& expected) const {
  return is_doubtful(place, expected) &&
         !(place && is_possible(*place, expected) && place->agreement.better_half() > kSharpHalf);
}

/// Of all motion blurs those that are likeliest at the places are aligned; the best view that is
/// not weak itself is taken.
void TargetSearch::follow_blurred(const std::array<Homography, 2>& starts,
                                  const std::optional<Expectation>& expected, Sighting& sighting) {
  guesses_.clear();
  for (std::size_t i = 0; i < blurred_.size(); ++i) {
    for (const Homography& start : starts) {
      guesses_.push_back({i, start, blurred_[i].detail(pyramid_, start)});
    }
  }
  const auto end = guesses_.begin() + std::ptrdiff_t(std::min(guesses_.size(), kTriedBlurs));
  std::partial_sort(guesses_.begin(), end, guesses_.end(), [](const Guess& a, const Guess& b) {
    return a.likeness != b.likeness ? a.likeness > b.likeness : a.blur < b.blur;
  });
  for (auto guess = guesses_.begin(); guess != end; ++guess) {
    const auto at = blurred_[guess->blur].align(pyramid_, guess->start);
    if (is_doubtful(at, expected) || (sighting.at && !is_better(*at, *sighting.at))) continue;
    sighting.at = at;
    sighting.stage = TrackStage::Searched;
  }
}

/// A place that shows so little of the template that it may be one where the template is like
/// itself is held against those places: the best of them all is taken, and none when two are as
/// good.
void TargetSearch::settle(const Frame& frame, const std::optional<Expectation>& expected,
                          Sighting& sighting) {
  if (!sighting.is_accepted() || self_.places.empty()) return;
  if (sighting.at->agreement.alike_share() >= sure_share(self_.share)) return;
  look(frame, {0, 0, double(frame.gray.cols), double(frame.gray.rows)});
  const Homography found = sighting.at->image_from_template;
  std::optional<Alignment> second;
  for (const Homography& place : self_.places) {
    for (const Eigen::Matrix3d& way :
         {Eigen::Matrix3d(place.H), Eigen::Matrix3d(place.H.inverse())}) {
      const auto rival = aligner_.align(pyramid_, Homography{found.H * way});
      if (!rival || !rival->is_accepted) continue;
      if (is_same(rival->image_from_template, sighting.at->image_from_template, model_)) continue;
      const bool better = is_better(*rival, *sighting.at);
      const Alignment& worse = better ? *sighting.at : *rival;
      if (!second || is_better(worse, *second)) second = worse;
      if (better) sighting.at = rival;
    }
  }
  const bool is_tie =
      second && second->agreement.shown() > kRivalShare * sighting.at->agreement.shown() &&
      !is_same(second->image_from_template, sighting.at->image_from_template, model_);
  sighting.miss = is_tie                                ? Miss::Ambiguous
                  : is_possible(*sighting.at, expected) ? Miss::None
                                                        : Miss::NotAlike;
}

Sighting TargetSearch::detect(const Frame& frame, const PixelBox& window,
                              const std::optional<Expectation>& expected) {
  Sighting result;
  result.stage = TrackStage::Detected;
  result.window = clipped(window, frame.gray.cols, frame.gray.rows);
  const Detection seen = detector_.detect(frame.gray, result.window);
  result.keypoints = seen.keypoints;
  result.matches = int(seen.pairs.size());
  result.miss = seen.keypoints < 4                                 ? Miss::FewKeypoints
                : result.matches < options_.detect.fit.min_inliers ? Miss::FewMatches
                                                                   : Miss::NoConsensus;
  if (seen.hypotheses.empty()) return result;
  std::vector<Place> places;
  for (int i = 0; i < int(seen.hypotheses.size()); ++i) {
    const Homography& start = seen.hypotheses[std::size_t(i)].image_from_template;
    look(frame, with_margin(box_of(start, model_)));
    if (const auto at = aligner_.align(pyramid_, start)) places.push_back({*at, i});
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return is_better(a.at, b.at); });
  result.miss = Miss::NotAlike;
  if (places.empty()) return result;
  const Choice choice = choose(places, expected);
  result.miss = choice.miss;
  result.at = places[choice.place].at;
  settle(frame, expected, result);
  if (result.is_accepted()) result.inliers = pairs_of(seen, places[choice.place].hypothesis);
  return result;
}

TargetSearch::Choice TargetSearch::choose(const std::vector<Place>& places,
                                          const std::optional<Expectation>& expected) const {
  const Alignment& best = places.front().at;
  if (!is_possible(best, expected)) return {0, Miss::NotAlike};
  const auto off = [&](std::size_t i) {
    return apart(places[i].at.image_from_template, expected->image_from_template, model_);
  };
  Choice choice;
  bool has_rival = false;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const Alignment& rival = places[i].at;
    if (!is_possible(rival, expected) ||
        rival.agreement.shown() <= kRivalShare * best.agreement.shown() ||
        is_same(rival.image_from_template, best.image_from_template, model_)) {
      continue;
    }
    has_rival = true;
    if (expected && off(i) < off(choice.place)) choice.place = i;
  }
  const bool is_told = expected && off(choice.place) <= kGate * expected->deviation_px;
  if (has_rival && !is_told) choice.miss = Miss::Ambiguous;
  return choice;
}

}  // namespace kestrel
