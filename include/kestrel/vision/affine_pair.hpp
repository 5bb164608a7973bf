#pragma once

#include <Eigen/Core>

#include "kestrel/geometry/pixel.hpp"

namespace kestrel {

/// A keypoint of the template seen in the image: where, the linear map of its neighbourhood
/// (template px -> image px, so one pair predicts an affine map), how distinctive it is.
struct AffinePair {
  Pixel in_template;
  Pixel in_image;
  Eigen::Matrix2f image_from_template = Eigen::Matrix2f::Identity();
  float ratio = 1;  // nearest over second nearest distance
  int template_index = 0;
  int image_index = 0;
};

}  // namespace kestrel
