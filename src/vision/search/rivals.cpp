#include "rivals.hpp"

#include <Eigen/LU>

#include "places.hpp"

namespace kestrel {
namespace {

/// A rival that shows this share of what the best place shows is as good as that.
constexpr double kRivalShare = 0.8;

}  // namespace

Choice choice(const std::vector<Place>& places, const std::optional<Expectation>& expected,
              const Verdict& verdict, const Template& model) {
  const Alignment& best = places.front().at;
  if (!verdict.is_possible(best, expected)) return {0, Miss::NotAlike};
  const auto off = [&](std::size_t i) {
    return apart(places[i].at.image_from_template, expected->image_from_template, model);
  };
  Choice result;
  bool has_rival = false;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const Alignment& rival = places[i].at;
    if (!verdict.is_possible(rival, expected) ||
        rival.agreement.shown() <= kRivalShare * best.agreement.shown() ||
        is_same(rival.image_from_template, best.image_from_template, model)) {
      continue;
    }
    has_rival = true;
    if (expected && off(i) < off(result.place)) result.place = i;
  }
  const bool is_told = expected && off(result.place) <= Verdict::kGate * expected->deviation_px;
  if (has_rival && !is_told) result.miss = Miss::Ambiguous;
  return result;
}

Settled settled(const Alignment& found, Aligner& aligner, const ImagePyramid& image,
                const std::optional<Expectation>& expected, const Verdict& verdict,
                const Template& model) {
  const Homography here = found.image_from_template;
  Alignment best = found;
  std::optional<Alignment> second;
  for (const Homography& place : verdict.self().places) {
    for (const Eigen::Matrix3d& way :
         {Eigen::Matrix3d(place.H), Eigen::Matrix3d(place.H.inverse())}) {
      const auto rival = aligner.align(image, Homography{here.H * way});
      if (!rival || !rival->is_accepted) continue;
      if (is_same(rival->image_from_template, best.image_from_template, model)) continue;
      const bool better = is_better(*rival, best);
      const Alignment& worse = better ? best : *rival;
      if (!second || is_better(worse, *second)) second = worse;
      if (better) best = *rival;
    }
  }
  const bool is_tie = second && second->agreement.shown() > kRivalShare * best.agreement.shown() &&
                      !is_same(second->image_from_template, best.image_from_template, model);
  const Miss miss = is_tie                                ? Miss::Ambiguous
                    : verdict.is_possible(best, expected) ? Miss::None
                                                          : Miss::NotAlike;
  return {best, miss};
}

}  // namespace kestrel
