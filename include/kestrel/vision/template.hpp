#pragma once

#include <opencv2/core/mat.hpp>

#include "kestrel/geometry/pixel.hpp"
#include "kestrel/vision/keypoints.hpp"
#include "kestrel/vision/match.hpp"

namespace kestrel {

/// What is learned once of the object: its picture, its keypoints in template coordinates (px from
/// the centre of the rectangle's first pixel) and the search tree over their descriptors.
class Template {
 public:
  /// Learns the rectangle box (whole pixels) of an 8-bit grey image. Throws std::invalid_argument
  /// that says what to do when the rectangle is not inside the image, is smaller than 16x16 px, or
  /// holds fewer than kMinKeypoints keypoints (no texture).
  Template(const cv::Mat& gray, const PixelBox& box, const SiftOptions& sift,
           const MatchOptions& match);

  static constexpr int kMinKeypoints = 12;

  const cv::Mat& picture() const { return picture_; }
  const Keypoints& keypoints() const { return keypoints_; }
  const Matcher& matcher() const { return matcher_; }
  double width() const { return picture_.cols; }
  double height() const { return picture_.rows; }
  /// Where the template was in the image it was learned from.
  const PixelBox& box() const { return box_; }

 private:
  PixelBox box_;
  cv::Mat picture_;
  Keypoints keypoints_;
  Matcher matcher_;
};

}  // namespace kestrel
