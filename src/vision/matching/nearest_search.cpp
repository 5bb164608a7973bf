#include "nearest_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace kestrel::matching {
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

std::int32_t squared_norm(const Descriptor& descriptor) {
  std::int32_t sum = 0;
  for (const std::uint8_t bin : descriptor.bin) sum += std::int32_t(bin) * bin;
  return sum;
}

}  // namespace

bool is_descriptor(const Descriptor& descriptor) {
  return squared_norm(descriptor) <= kMaxNorm &&
         std::all_of(descriptor.bin.begin(), descriptor.bin.end(),
                     [](std::uint8_t bin) { return bin <= 127; });
}

NearestSearch::NearestSearch(const LearnedFeatures& model, double same_place_px, Simd simd)
    : table_(&kernels::table(simd)),
      blocks_((int(model.at.size()) + kModelBlock - 1) / kModelBlock) {
  pack(model.descriptors);
  find_neighbours(model.at, same_place_px);
  distances_.resize(std::size_t(kQueries) * std::size_t(row_size()));
}

/// Eight descriptors side by side, four bins at a time.
void NearestSearch::pack(const std::vector<Descriptor>& descriptors) {
  packed_.assign(std::size_t(row_size()) * 128, 0);
  norms_.assign(std::size_t(row_size()), kNoNorm);
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    const std::size_t block = i / kModelBlock;
    const std::size_t lane = i % kModelBlock;
    for (std::size_t b = 0; b < 128; ++b)
      packed_[((block * 32 + b / 4) * kModelBlock + lane) * 4 + b % 4] = descriptors[i].bin[b];
    norms_[i] = squared_norm(descriptors[i]);
  }
}

void NearestSearch::find_neighbours(const std::vector<LearnedFeature>& features,
                                    double same_place_px) {
  for (const LearnedFeature& a : features) {
    first_neighbour_.push_back(int(neighbours_.size()));
    for (std::size_t i = 0; i < features.size(); ++i) {
      const Pixel& at = features[i].in_template;
      if (std::abs(a.in_template.u - at.u) > same_place_px) continue;  // most: spares the root
      if (distance(a.in_template, at) <= same_place_px) neighbours_.push_back(int(i));
    }
  }
  first_neighbour_.push_back(int(neighbours_.size()));
}

void NearestSearch::compare(const std::vector<Descriptor>& image) {
  nearest_query_.assign(std::size_t(row_size()), kNever << kIndexBits | kIndexMask);
  nearest_.clear();
  for (int first = 0; first < int(image.size()); first += kQueries) compare_block(image, first);
  mutual_.clear();
  for (const Claim& c : nearest_) {
    if ((nearest_query_[std::size_t(c.in_template)] & kIndexMask) == c.in_image)
      mutual_.push_back(c);
  }
}

/// Four keypoints at a time.
void NearestSearch::compare_block(const std::vector<Descriptor>& image, int first) {
  const int count = int(image.size());
  std::array<const std::uint8_t*, kQueries> queries{};
  std::array<std::int32_t, kQueries> query_norms{};
  std::array<std::int32_t*, kQueries> rows{};
  for (int q = 0; q < kQueries; ++q) {
    const Descriptor& query = image[std::size_t(std::min(first + q, count - 1))];
    queries[std::size_t(q)] = query.bin.data();
    query_norms[std::size_t(q)] = squared_norm(query);
    rows[std::size_t(q)] = row(q);
  }
  kernels::DistanceBlock block{};
  block.count = std::min(kQueries, count - first);
  block.model = packed_.data();
  block.model_norms = norms_.data();
  block.blocks = blocks_;
  block.queries = queries.data();
  block.query_norms = query_norms.data();
  block.distances = rows.data();
  block.nearest_query = nearest_query_.data();
  block.first_query = first;
  table_->compare(block);
  for (int q = 0; q < block.count; ++q) nearest_.push_back(nearest(first + q, row(q)));
}

/// The nearest feature, then the nearest of those at other places.
Claim NearestSearch::nearest(int query, std::int32_t* row) const {
  const std::int32_t key = table_->nearest(row, blocks_);
  const int at = key & kIndexMask;
  for (int k = first_neighbour_[std::size_t(at)]; k < first_neighbour_[std::size_t(at) + 1]; ++k)
    row[neighbours_[std::size_t(k)]] = kNever;
  const std::int32_t first = key >> kIndexBits;
  const std::int32_t second = table_->nearest(row, blocks_) >> kIndexBits;
  // Without another place nothing says that this one is distinctive.
  const bool is_alone = second == 0 || second > 2 * kMaxNorm;
  return {is_alone ? 1 : std::sqrt(float(first) / float(second)), at, query};
}

}  // namespace kestrel::matching
