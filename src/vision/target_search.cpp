#include "kestrel/vision/target_search.hpp"

#include <algorithm>
#include <utility>

#include "kestrel/vision/detector.hpp"
#include "kestrel/vision/image_pyramid.hpp"

#include "search/blurred_views.hpp"
#include "search/parted.hpp"
#include "search/places.hpp"
#include "search/rivals.hpp"
#include "search/verdict.hpp"

namespace kestrel {

struct TargetSearch::Parts {
  const Template& model;
  TrackOptions options;
  Verdict verdict;
  Aligner aligner;
  std::optional<BlurredViews> blurred;  // not of a template that is like itself
  Detector detector;
  ImagePyramid pyramid;

  Parts(const Template& learned, const TrackOptions& wanted)
      : model(learned),
        options(wanted),
        verdict(learned, wanted),
        aligner(learned.blocks(), align_options(wanted)),
        detector(learned, wanted) {
    // Blurred, a picture that is like itself is so even more: any of those places would do.
    if (verdict.self().places.empty()) blurred.emplace(learned, align_options(wanted));
  }

  void look(const Frame& frame, const PixelBox& window) {
    pyramid.look(frame.gray, window, aligner.levels(), options.simd);
  }

  Sighting follow(const Frame& frame, const Homography& last,
                  const std::optional<Expectation>& expected);
  void look_around(const Frame& frame, const Homography& start,
                   const std::optional<Expectation>& expected, Sighting& sighting);
  void follow_blurred(const Homography& around, const Homography& found,
                      const std::optional<Expectation>& expected, Sighting& sighting);
  void refine_blurred(const std::optional<Expectation>& expected, Sighting& sighting);
  void settle(const Frame& frame, const std::optional<Expectation>& expected, Sighting& sighting);
  Sighting detect(const Frame& frame, const PixelBox& window,
                  const std::optional<Expectation>& expected, Structures structures);
  std::optional<int> judge(const Frame& frame, const Detection& seen,
                           const std::optional<Expectation>& expected, Sighting& result);
};

Sighting TargetSearch::Parts::follow(const Frame& frame, const Homography& last,
                                     const std::optional<Expectation>& expected) {
  const Homography& ahead = expected ? expected->image_from_template : last;
  Sighting result;
  result.stage = TrackStage::Aligned;
  result.window = clipped(with_margin(united(box_of(last, model), box_of(ahead, model))),
                          frame.gray.cols, frame.gray.rows);
  look(frame, result.window);
  const bool moves = aligner.likeness(pyramid, ahead) >= aligner.likeness(pyramid, last);
  const Homography& start = moves ? ahead : last;
  result.at = aligner.align(pyramid, start);
  if (verdict.is_doubtful(result.at, expected)) look_around(frame, start, expected, result);
  if (result.at && verdict.is_possible(*result.at, expected)) {
    result.miss = Miss::None;
    refine_blurred(expected, result);
  }
  settle(frame, expected, result);
  return result;
}

/// A doubtful place is aligned on, then searched around, then looked for as motion blurs it.
void TargetSearch::Parts::look_around(const Frame& frame, const Homography& start,
                                      const std::optional<Expectation>& expected,
                                      Sighting& sighting) {
  sighting.window = whole(frame);
  look(frame, sighting.window);
  const Homography around = aligner.search(pyramid, start);
  const auto improve_from = [&](const Homography& from, TrackStage stage) {
    const auto at = aligner.align(pyramid, from);
    if (!at || (sighting.at && !is_better(*at, *sighting.at))) return;
    sighting.at = at;
    sighting.stage = stage;
  };
  // The steps may have run out: they go on.
  if (sighting.at) improve_from(Homography(sighting.at->image_from_template), TrackStage::Aligned);
  improve_from(around, TrackStage::Searched);
  if (verdict.may_be_blurred(sighting.at, expected)) {
    const Homography found = sighting.at ? sighting.at->image_from_template : start;
    follow_blurred(around, found, expected, sighting);
  }
}

/// Of all blurs those that are likeliest at the places are aligned; the best view that is
/// evident is taken. Only as long as the motion expects the target near here: one that was lost
/// may be anywhere, and what is smooth looks like some blur of it.
void TargetSearch::Parts::follow_blurred(const Homography& around, const Homography& found,
                                         const std::optional<Expectation>& expected,
                                         Sighting& sighting) {
  if (!blurred || !expected) return;
  for (const auto& guess : blurred->likeliest(pyramid, {around, found})) {
    const auto at = blurred->align(pyramid, guess);
    if (verdict.is_doubtful(at, expected) || !Verdict::is_evident_blurred(*at)) continue;
    if (sighting.at && !is_better(*at, *sighting.at)) continue;
    sighting.at = at;
    sighting.stage = TrackStage::Searched;
  }
}

/// A place found that is not sharp is aligned again as the blurs that are likeliest there show the
/// template: a block of 8 px holds only a part of a blurred edge, and the sharp one laid over it is
/// led astray. What is taken shows more at that same place, and leaves less of it open.
void TargetSearch::Parts::refine_blurred(const std::optional<Expectation>& expected,
                                         Sighting& sighting) {
  if (!blurred || verdict.is_sharp(*sighting.at)) return;
  const Homography found = sighting.at->image_from_template;
  const double sharp = aligner.detail(pyramid, found);
  for (const auto& guess : blurred->likeliest(pyramid, {found})) {
    if (guess.likeness <= sharp) break;  // the others are less likely still
    const auto at = blurred->align(pyramid, guess);
    if (verdict.is_doubtful(at, expected) || !is_same(at->image_from_template, found, model))
      continue;
    const bool tells_more = at->corner_covariance.trace() < sighting.at->corner_covariance.trace();
    if (tells_more && is_better(*at, *sighting.at)) sighting.at = at;
  }
}

/// A place that shows so little of the template that it may be another part of it is held against
/// those.
void TargetSearch::Parts::settle(const Frame& frame, const std::optional<Expectation>& expected,
                                 Sighting& sighting) {
  if (!sighting.is_accepted() || !verdict.may_be_another(*sighting.at)) return;
  look(frame, whole(frame));
  const Settled left = settled(*sighting.at, aligner, pyramid, expected, verdict, model);
  sighting.at = left.at;
  sighting.miss = left.miss;
}

Sighting TargetSearch::Parts::detect(const Frame& frame, const PixelBox& window,
                                     const std::optional<Expectation>& expected,
                                     Structures structures) {
  Sighting result;
  result.stage = TrackStage::Detected;
  result.window = clipped(window, frame.gray.cols, frame.gray.rows);
  const Detection seen = detector.detect(frame.gray, result.window, structures);
  result.keypoints = seen.keypoints;
  result.matches = int(seen.pairs.size());
  result.miss = seen.keypoints < 4                                ? Miss::FewKeypoints
                : result.matches < options.detect.fit.min_inliers ? Miss::FewMatches
                                                                  : Miss::NoConsensus;
  const auto hypothesis = judge(frame, seen, expected, result);
  PartedPairs matched =
      parted(seen.pairs,
             hypothesis ? seen.hypotheses[std::size_t(*hypothesis)].inliers : std::vector<int>{});
  result.inliers = std::move(matched.inliers);
  result.others = std::move(matched.others);
  return result;
}

/// The pixels' verdict on what the keypoints lead to: the hypothesis that is accepted.
std::optional<int> TargetSearch::Parts::judge(const Frame& frame, const Detection& seen,
                                              const std::optional<Expectation>& expected,
                                              Sighting& result) {
  if (seen.hypotheses.empty()) return std::nullopt;
  std::vector<Place> places;
  for (int i = 0; i < int(seen.hypotheses.size()); ++i) {
    const Homography& start = seen.hypotheses[std::size_t(i)].image_from_template;
    look(frame, with_margin(box_of(start, model)));
    if (const auto at = aligner.align(pyramid, start)) places.push_back({*at, i});
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return is_better(a.at, b.at); });
  result.miss = Miss::NotAlike;
  if (places.empty()) return std::nullopt;
  const Choice chosen = choice(places, expected, verdict, model);
  result.miss = chosen.miss;
  result.at = places[chosen.place].at;
  settle(frame, expected, result);
  if (!result.is_accepted()) return std::nullopt;
  return places[chosen.place].hypothesis;
}

TargetSearch::TargetSearch(const Template& model, const TrackOptions& options)
    : parts_(std::make_unique<Parts>(model, options)) {}

TargetSearch::~TargetSearch() = default;
TargetSearch::TargetSearch(TargetSearch&&) noexcept = default;
TargetSearch& TargetSearch::operator=(TargetSearch&&) noexcept = default;

Sighting TargetSearch::follow(const Frame& frame, const Homography& last,
                              const std::optional<Expectation>& expected) {
  return parts_->follow(frame, last, expected);
}

Sighting TargetSearch::detect(const Frame& frame, const PixelBox& window,
                              const std::optional<Expectation>& expected) {
  Sighting seen = parts_->detect(frame, window, expected, Structures::Usual);
  // Of two places that are alike a second look might miss one and take the other.
  if (seen.is_accepted() || seen.miss == Miss::Ambiguous) return seen;
  const auto ahead = expected ? std::optional(expected->image_from_template) : std::nullopt;
  if (!parts_->detector.has_second_look(ahead)) return seen;
  Sighting again = parts_->detect(frame, window, expected, Structures::Small);
  return again.is_accepted() ? again : seen;
}

bool TargetSearch::is_weak(const Alignment& place) const { return parts_->verdict.is_weak(place); }

}  // namespace kestrel
