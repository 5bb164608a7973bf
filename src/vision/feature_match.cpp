#include "kestrel/vision/feature_match.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "kernels/kernels.hpp"
#include "sift/exact_math.hpp"

namespace kestrel {
namespace {

using kernels::kIndexBits;
using kernels::kModelBlock;
using kernels::kQueries;

constexpr std::int32_t kIndexMask = (1 << kIndexBits) - 1;
static_assert(kMaxSiftPoints <= kIndexMask);

/// Largest squared norm: bins 256 s + 1/2 with a sum of s^2 of 1 and of s of at most sqrt(128).
constexpr std::int32_t kMaxNorm = 68465;

/// Farther than any two descriptors, and still a key with room for an index.
constexpr std::int32_t kNever = (1 << (31 - kIndexBits)) - 1;
constexpr std::int32_t kNoNorm = kNever - kMaxNorm;  // of what is not there
static_assert(kNoNorm > 2 * kMaxNorm);

void require(bool holds, const char* message) {
  if (!holds) throw std::invalid_argument(message);
}

std::int32_t squared_norm(const Descriptor& descriptor) {
  std::int32_t sum = 0;
  for (const std::uint8_t bin : descriptor.bin) sum += std::int32_t(bin) * bin;
  return sum;
}

bool is_descriptor(const Descriptor& descriptor) {
  return squared_norm(descriptor) <= kMaxNorm &&
         std::all_of(descriptor.bin.begin(), descriptor.bin.end(),
                     [](std::uint8_t bin) { return bin <= 127; });
}

double squared_distance(const Pixel& a, const Pixel& b) {
  return (a.u - b.u) * (a.u - b.u) + (a.v - b.v) * (a.v - b.v);
}

/// A pair of nearest neighbours before places are compared.
struct Claim {
  float ratio = 1;
  int in_template = 0;
  int in_image = 0;
};

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
  Work(const LearnedFeatures& learned, const FeatureMatchOptions& wanted);

  void pack();
  void find_neighbours();
  void compare(const SiftPoints& image);
  void take_nearest(int query, std::int32_t* distances);
  void claim();
  void keep_places(const SiftPoints& image);

  LearnedFeatures model;
  FeatureMatchOptions options;
  const kernels::Table* table;
  int blocks;
  std::vector<std::uint8_t> packed;  // blocks x 32 steps x 8 descriptors x 4 bins
  std::vector<std::int32_t> norms;   // of the model, kNoNorm beyond its end
  std::vector<int> neighbours;       // features at the place of feature i (itself too):
  std::vector<int> first_neighbour;  //   from first_neighbour[i] to first_neighbour[i + 1]
  std::vector<std::int32_t> distances;
  std::vector<std::int32_t> nearest_query;
  std::vector<Claim> nearest;  // per image keypoint
  std::vector<Claim> claims;
  std::vector<AffinePair> pairs;
};

FeatureMatcher::Work::Work(const LearnedFeatures& learned, const FeatureMatchOptions& wanted)
    : model(learned),
      options(wanted),
      table(&kernels::table(wanted.simd)),
      blocks((int(learned.at.size()) + kModelBlock - 1) / kModelBlock) {
  pack();
  find_neighbours();
  distances.resize(std::size_t(kQueries * blocks * kModelBlock));
}

/// Eight descriptors side by side, four bins at a time.
void FeatureMatcher::Work::pack() {
  packed.assign(std::size_t(blocks) * kModelBlock * 128, 0);
  norms.assign(std::size_t(blocks * kModelBlock), kNoNorm);
  for (std::size_t i = 0; i < model.descriptors.size(); ++i) {
    const std::size_t block = i / kModelBlock;
    const std::size_t lane = i % kModelBlock;
    for (std::size_t b = 0; b < 128; ++b)
      packed[((block * 32 + b / 4) * kModelBlock + lane) * 4 + b % 4] = model.descriptors[i].bin[b];
    norms[i] = squared_norm(model.descriptors[i]);
  }
}

void FeatureMatcher::Work::find_neighbours() {
  const double radius = options.same_place_px * options.same_place_px;
  for (const LearnedFeature& a : model.at) {
    first_neighbour.push_back(int(neighbours.size()));
    for (std::size_t i = 0; i < model.at.size(); ++i)
      if (squared_distance(a.in_template, model.at[i].in_template) <= radius)
        neighbours.push_back(int(i));
  }
  first_neighbour.push_back(int(neighbours.size()));
}

/// All distances, four image keypoints at a time; of each the nearest and its ratio.
void FeatureMatcher::Work::compare(const SiftPoints& image) {
  const int count = int(image.descriptors.size());
  const int row = blocks * kModelBlock;
  nearest_query.assign(std::size_t(row), kNever << kIndexBits | kIndexMask);
  nearest.resize(std::size_t(count));
  for (int first = 0; first < count; first += kQueries) {
    kernels::DistanceBlock block{};
    std::array<const std::uint8_t*, kQueries> queries{};
    std::array<std::int32_t, kQueries> query_norms{};
    std::array<std::int32_t*, kQueries> rows{};
    block.count = std::min(kQueries, count - first);
    for (int q = 0; q < kQueries; ++q) {
      const Descriptor& query = image.descriptors[std::size_t(std::min(first + q, count - 1))];
      queries[std::size_t(q)] = query.bin.data();
      query_norms[std::size_t(q)] = squared_norm(query);
      rows[std::size_t(q)] = distances.data() + q * row;
    }
    block.model = packed.data();
    block.model_norms = norms.data();
    block.blocks = blocks;
    block.queries = queries.data();
    block.query_norms = query_norms.data();
    block.distances = rows.data();
    block.nearest_query = nearest_query.data();
    block.first_query = first;
    table->compare(block);
    for (int q = 0; q < block.count; ++q) take_nearest(first + q, rows[std::size_t(q)]);
  }
}

void FeatureMatcher::Work::take_nearest(int query, std::int32_t* row) {
  const std::int32_t key = table->nearest(row, blocks);
  const int at = key & kIndexMask;
  for (int k = first_neighbour[std::size_t(at)]; k < first_neighbour[std::size_t(at) + 1]; ++k)
    row[neighbours[std::size_t(k)]] = kNever;
  const std::int32_t first = key >> kIndexBits;
  const std::int32_t second = table->nearest(row, blocks) >> kIndexBits;
  // Without another place nothing says that this one is distinctive.
  const bool is_alone = second == 0 || second > 2 * kMaxNorm;
  const float ratio = is_alone ? 1 : std::sqrt(float(first) / float(second));
  nearest[std::size_t(query)] = {ratio, at, query};
}

void FeatureMatcher::Work::claim() {
  claims.clear();
  for (const Claim& c : nearest) {
    const bool is_mutual = (nearest_query[std::size_t(c.in_template)] & kIndexMask) == c.in_image;
    if (is_mutual && double(c.ratio) < options.ratio) claims.push_back(c);
  }
  std::sort(claims.begin(), claims.end(), [](const Claim& a, const Claim& b) {
    return a.ratio != b.ratio ? a.ratio < b.ratio : a.in_image < b.in_image;
  });
}

void FeatureMatcher::Work::keep_places(const SiftPoints& image) {
  const double radius = options.same_place_px * options.same_place_px;
  pairs.clear();
  for (const Claim& c : claims) {
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
  require(std::all_of(model.descriptors.begin(), model.descriptors.end(), is_descriptor),
          "model: descriptors must be RootSIFT in 7 bits");
  work_ = std::make_unique<Work>(model, options);
}

FeatureMatcher::~FeatureMatcher() = default;
FeatureMatcher::FeatureMatcher(FeatureMatcher&&) noexcept = default;
FeatureMatcher& FeatureMatcher::operator=(FeatureMatcher&&) noexcept = default;

const std::vector<AffinePair>& FeatureMatcher::match(const SiftPoints& image) {
  require(image.at.size() == image.descriptors.size(), "image: as many places as descriptors");
  require(image.at.size() <= std::size_t(kMaxSiftPoints), "image: at most 8000 keypoints");
  require(std::all_of(image.descriptors.begin(), image.descriptors.end(), is_descriptor),
          "image: descriptors must be RootSIFT in 7 bits");
  work_->pairs.clear();
  if (work_->model.at.empty() || image.at.empty()) return work_->pairs;
  work_->compare(image);
  work_->claim();
  work_->keep_places(image);
  return work_->pairs;
}

std::vector<AffinePair> match_features(const LearnedFeatures& model, const SiftPoints& image,
                                       const FeatureMatchOptions& options) {
  return FeatureMatcher(model, options).match(image);
}

}  // namespace kestrel
