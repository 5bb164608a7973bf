#pragma once

#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "kestrel/geometry/pixel.hpp"
#include "kestrel/vision/sift.hpp"

namespace kestrel {

/// A keypoint of the template, found in one of several views of it.
struct LearnedFeature {
  Pixel in_template;  // px from the centre of the rectangle's first pixel
  /// Template px from the keypoint -> the keypoint's own frame, where its scale is 1 and its angle
  /// 0; takes in the view's affine map.
  Eigen::Matrix2f from_template;
  float scale_px = 0;  // template px; of a tilted view the geometric mean over the directions
  int view = 0;        // 0 is the enlarged one
};

/// Keypoints of the template and, in the same order, what they look like.
struct LearnedFeatures {
  std::vector<LearnedFeature> at;
  std::vector<Descriptor> descriptors;
};

/// Most features of a template, all views together: matching costs their product with the image's.
constexpr int kMaxLearnedFeatures = 1500;

/// Affine maps of the views a template is learned from, template px -> view px: enlarged twice,
/// then compressed to 0.62 along eight directions 22.5 degrees apart. Whatever the direction of a
/// tilt of up to 60 degrees, some view then looks the same up to a compression of 0.73, that of a
/// tilt of 43 degrees, which SIFT bears (ASIFT, Yu & Morel 2011, simulates tilts the same way).
std::vector<Eigen::Matrix2d> template_views();

/// What is learned once of the rectangle box (whole pixels) of an 8-bit grey image: the SIFT
/// keypoints of all views that lie in it. The views show what surrounds the rectangle too, as
/// Template does: a descriptor near its edge reaches over it, and the first window shows the same.
/// A third of kMaxLearnedFeatures is for the enlarged view, the rest for the others alike; of each
/// the strongest. `sift` says how the image is searched; its is_doubled and max_keypoints do not
/// count here. Throws std::invalid_argument when box is not inside the image or is empty, or the
/// image is not 8-bit grey.
LearnedFeatures learn_features(const cv::Mat& gray, const PixelBox& box,
                               const FastSiftOptions& sift);

}  // namespace kestrel
