#include "kestrel/vision/feature_match.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "matching/nearest_search.hpp"
#include "sift/exact_math.hpp"

namespace kestrel {
namespace {

void require(bool holds, const char* message) {
  if (!holds) throw std::invalid_argument(message);
}

double squared_distance(const Pixel& a, const Pixel& b) {
  return (a.u - b.u) * (a.u - b.u) + (a.v - b.v) * (a.v - b.v);
}

Eigen::Matrix2f image_from_unit(const SiftPoint& point) {
  const sift::Direction along = sift::direction(double(point.angle_rad));
  const float cosine = float(along.cosine) * point.scale_px;
  const float sine = float(along.sine) * point.scale_px;
  Eigen::Matrix2f result;
  result << cosine, -sine, sine, cosine;
  return result;
}

}  // namespace

void FeatureMatchOptions::check() const {
  require(ratio > 0 && ratio <= 1, "match.ratio: must be above 0 and at most 1");
  require(max_pairs >= 1, "match.max_pairs: must be at least 1");
  require(same_place_px >= 0 && std::isfinite(same_place_px),
          "match.same_place_px: must be at least 0");
}

struct FeatureMatcher::Work {
  Work(const LearnedFeatures& learned, const FeatureMatchOptions& wanted)
      : model(learned), options(wanted), search(learned, wanted.same_place_px, wanted.simd) {}

  void claim();
  void keep_places(const SiftPoints& image);

  LearnedFeatures model;
  FeatureMatchOptions options;
  matching::NearestSearch search;
  std::vector<matching::Claim> claims;
  std::vector<AffinePair> pairs;
};

void FeatureMatcher::Work::claim() {
  claims.clear();
  for (const matching::Claim& c : search.mutual())
    if (double(c.ratio) < options.ratio) claims.push_back(c);
  std::sort(claims.begin(), claims.end(), [](const matching::Claim& a, const matching::Claim& b) {
    return a.ratio != b.ratio ? a.ratio < b.ratio : a.in_image < b.in_image;
  });
}

void FeatureMatcher::Work::keep_places(const SiftPoints& image) {
  const double radius = options.same_place_px * options.same_place_px;
  pairs.clear();
  for (const matching::Claim& c : claims) {
    if (int(pairs.size()) == options.max_pairs) return;
    const LearnedFeature& feature = model.at[std::size_t(c.in_template)];
    const SiftPoint& point = image.at[std::size_t(c.in_image)];
    const Pixel in_image{double(point.u), double(point.v)};
    const bool is_taken = std::any_of(pairs.begin(), pairs.end(), [&](const AffinePair& p) {
      return squared_distance(p.in_template, feature.in_template) <= radius ||
             squared_distance(p.in_image, in_image) <= radius;
    });
    if (is_taken) continue;
    pairs.push_back({feature.in_template, in_image, image_from_unit(point) * feature.from_template,
                     c.ratio, c.in_template, c.in_image});
  }
}

FeatureMatcher::FeatureMatcher(const LearnedFeatures& model, const FeatureMatchOptions& options) {
  options.check();
  require(model.at.size() == model.descriptors.size(), "model: as many places as descriptors");
  require(model.at.size() <= std::size_t(kMaxSiftPoints), "model: at most 8000 features");
  require(std::all_of(model.descriptors.begin(), model.descriptors.end(), matching::is_descriptor),
          "model: descriptors must be RootSIFT in 7 bits");
  work_ = std::make_unique<Work>(model, options);
}

FeatureMatcher::~FeatureMatcher() = default;
FeatureMatcher::FeatureMatcher(FeatureMatcher&&) noexcept = default;
FeatureMatcher& FeatureMatcher::operator=(FeatureMatcher&&) noexcept = default;

const std::vector<AffinePair>& FeatureMatcher::match(const SiftPoints& image) {
  require(image.at.size() == image.descriptors.size(), "image: as many places as descriptors");
  require(image.at.size() <= std::size_t(kMaxSiftPoints), "image: at most 8000 keypoints");
  require(std::all_of(image.descriptors.begin(), image.descriptors.end(), matching::is_descriptor),
          "image: descriptors must be RootSIFT in 7 bits");
  work_->pairs.clear();
  if (work_->model.at.empty() || image.at.empty()) return work_->pairs;
  work_->search.compare(image.descriptors);
  work_->claim();
  work_->keep_places(image);
  return work_->pairs;
}

std::vector<AffinePair> match_features(const LearnedFeatures& model, const SiftPoints& image,
                                       const FeatureMatchOptions& options) {
  return FeatureMatcher(model, options).match(image);
}

}  // namespace kestrel
