#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "kestrel/geometry/pixel.hpp"
#include "kestrel/vision/learned_features.hpp"
#include "kestrel/vision/sift.hpp"

namespace kestrel {

/// A keypoint of the template seen in the image.
struct AffinePair {
  Pixel in_template;
  Pixel in_image;
  /// Template px -> image px about the pair: one pair predicts an affine map.
  Eigen::Matrix2f image_from_template;
  float ratio = 1;  // nearest over second nearest distance: small is distinctive
  int in_template_index = 0;
  int in_image_index = 0;
};

/// Parameters of the exact search.
struct FeatureMatchOptions {
  double ratio = 0.88;       // largest accepted
  int max_pairs = 400;       // the most distinctive
  double same_place_px = 2;  // features nearer to each other count as one place
  Simd simd = Simd::Auto;

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// Matches images against one template; keeps its memory from image to image.
class FeatureMatcher {
 public:
  /// Throws std::invalid_argument for options out of range, for descriptors and places that are not
  /// as many, for more than kMaxSiftPoints of them, and for descriptors that are not RootSIFT in
  /// 7 bits (bins at most 127, norm about 256).
  FeatureMatcher(const LearnedFeatures& model, const FeatureMatchOptions& options);
  ~FeatureMatcher();
  FeatureMatcher(FeatureMatcher&&) noexcept;
  FeatureMatcher& operator=(FeatureMatcher&&) noexcept;

  /// Pairs that are each other's nearest neighbours by descriptor, exactly; whose distance is less
  /// than ratio times that of the nearest at another place of the template (views repeat a place);
  /// and that are one to one: of pairs that share a place in the template or in the image the most
  /// distinctive stays. The max_pairs best, best first, ties in the order of the image's keypoints.
  /// Throws std::invalid_argument for an image of keypoints the model could not be of. Valid until
  /// the next call; no allocation for images with no more keypoints than before.
  const std::vector<AffinePair>& match(const SiftPoints& image);

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

/// The same for once.
std::vector<AffinePair> match_features(const LearnedFeatures& model, const SiftPoints& image,
                                       const FeatureMatchOptions& options);

}  // namespace kestrel
