#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kestrel/vision/learned_features.hpp"
#include "kestrel/vision/sift.hpp"

#include "../kernels/kernels.hpp"

namespace kestrel::matching {

/// A feature of the template and a keypoint of the image that may be the same.
struct Claim {
  float ratio = 1;  // nearest distance over that of the nearest at another place
  int in_template = 0;
  int in_image = 0;
};

/// Whether bins and norm are what RootSIFT in 7 bits can have.
bool is_descriptor(const Descriptor& descriptor);

/// Exact nearest neighbours of an image's descriptors among a model's; both must hold descriptors
/// only, at most kMaxSiftPoints. Of equally near ones the first.
class NearestSearch {
 public:
  /// Features within same_place_px of each other are at one place.
  NearestSearch(const LearnedFeatures& model, double same_place_px, Simd simd);

  /// Takes all distances; not for an empty model or image.
  void compare(const std::vector<Descriptor>& image);
  /// The image's keypoints whose nearest feature has them as its nearest keypoint, in their order.
  const std::vector<Claim>& mutual() const { return mutual_; }

 private:
  void pack(const std::vector<Descriptor>& descriptors);
  void find_neighbours(const std::vector<LearnedFeature>& features, double same_place_px);
  void compare_block(const std::vector<Descriptor>& image, int first);
  Claim nearest(int query, std::int32_t* row) const;
  std::int32_t* row(int query) { return distances_.data() + std::ptrdiff_t(query) * row_size(); }
  int row_size() const { return blocks_ * kernels::kModelBlock; }

  const kernels::Table* table_;
  int blocks_;
  std::vector<std::uint8_t> packed_;  // blocks x 32 steps x 8 descriptors x 4 bins
  std::vector<std::int32_t> norms_;   // of the model, kNoNorm beyond its end
  std::vector<int> neighbours_;       // features at the place of feature i, itself too: from
  std::vector<int> first_neighbour_;  //   first_neighbour_[i] to first_neighbour_[i + 1]
  std::vector<std::int32_t> distances_;
  std::vector<std::int32_t> nearest_query_;  // per feature: distance << kIndexBits | keypoint
  std::vector<Claim> nearest_;               // per keypoint
  std::vector<Claim> mutual_;
};

}  // namespace kestrel::matching
