#include "kestrel/vision/self_likeness.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

namespace kestrel {
namespace {

/// Shifts tried, in eighths of the picture's size, to each side: beyond half of it too little is
/// left to compare.
constexpr int kEighths = 4;

/// Starts that are aligned; a third of all. Bounds the time to learn a template.
constexpr std::size_t kMaxStarts = 96;

/// An answer this near to the picture itself, as a share of its longer side, is the picture itself.
constexpr double kSamePlaceShare = 0.06;

/// The picture turned about its centre by so many quarters, then shifted.
Homography moved(const TemplateBlocks& b, int quarters, double du, double dv) {
  const double u = (b.width - 1) / 2;
  const double v = (b.height - 1) / 2;
  const double c = std::array<double, 4>{1, 0, -1, 0}[std::size_t(quarters)];
  const double s = std::array<double, 4>{0, 1, 0, -1}[std::size_t(quarters)];
  Eigen::Matrix3d H;
  H << c, -s, u - c * u + s * v + du, s, c, v - s * u - c * v + dv, 0, 0, 1;
  return {H};
}

struct Place {
  Homography where;
  double share = 0;
};

double apart(const Homography& a, const Homography& b, const TemplateBlocks& blocks) {
  const auto at = outline(a, blocks.width, blocks.height);
  const auto to = outline(b, blocks.width, blocks.height);
  double farthest = 0;
  for (std::size_t i = 0; i < 4; ++i) farthest = std::max(farthest, distance(at[i], to[i]));
  return farthest;
}

/// The shifts and turns to align from: of all, those at which the coarsest level is most alike.
std::vector<Homography> starts(const TemplateBlocks& blocks, Aligner& aligner,
                               const ImagePyramid& pyramid) {
  std::vector<Place> all;
  for (int quarters = 0; quarters < 4; ++quarters) {
    for (int j = -kEighths; j <= kEighths; ++j) {
      for (int i = -kEighths; i <= kEighths; ++i) {
        if (quarters == 0 && i == 0 && j == 0) continue;
        const Homography H = moved(blocks, quarters, i * blocks.width / 8, j * blocks.height / 8);
        all.push_back({H, aligner.likeness(pyramid, H)});
      }
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Place& a, const Place& b) { return a.share > b.share; });
  std::vector<Homography> best;
  for (std::size_t i = 0; i < std::min(all.size(), kMaxStarts); ++i) best.push_back(all[i].where);
  return best;
}

/// The most alike of the places, those that are the same once.
SelfLikeness distinct(std::vector<Place> places, const TemplateBlocks& blocks) {
  const double near = kSamePlaceShare * std::max(blocks.width, blocks.height);
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.share > b.share; });
  SelfLikeness result;
  for (const Place& place : places) {
    const bool is_new = std::all_of(
        result.places.begin(), result.places.end(),
        [&](const Homography& known) { return apart(known, place.where, blocks) > near; });
    if (is_new && result.places.size() < SelfLikeness::kMaxPlaces) {
      result.places.push_back(place.where);
    }
  }
  if (!places.empty()) result.share = places.front().share;
  return result;
}

}  // namespace

SelfLikeness self_likeness(const cv::Mat& picture, const TemplateBlocks& blocks,
                           const AlignOptions& options) {
  Aligner aligner(blocks, options);
  ImagePyramid pyramid;
  pyramid.look(picture, {0, 0, blocks.width, blocks.height}, aligner.levels(), options.simd);
  const double near = kSamePlaceShare * std::max(blocks.width, blocks.height);
  std::vector<Place> places;
  for (const Homography& start : starts(blocks, aligner, pyramid)) {
    const auto found = aligner.align(pyramid, start);
    if (!found || !found->is_accepted) continue;
    if (apart(found->image_from_template, Homography(), blocks) <= near) continue;
    places.push_back({found->image_from_template,
                      found->agreement.alike_share() * found->agreement.fine.visible_share()});
  }
  return distinct(std::move(places), blocks);
}

AgreementOptions beyond_self_likeness(AgreementOptions options, double share) {
  if (share > 0) options.min_alike_share = std::max(options.min_alike_share, 0.25 + share / 2);
  return options;
}

double sure_share(double self_likeness_share) { return (1 + self_likeness_share) / 2; }

}  // namespace kestrel
