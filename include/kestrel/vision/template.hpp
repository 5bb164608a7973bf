#pragma once

#include <optional>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "kestrel/geometry/pixel.hpp"
#include "kestrel/vision/keypoints.hpp"
#include "kestrel/vision/learned_features.hpp"
#include "kestrel/vision/match.hpp"
#include "kestrel/vision/template_blocks.hpp"
#include "kestrel/vision/track_options.hpp"

namespace kestrel {

/// What is learned once of the object: its picture and what the method needs to find it again.
/// Places are in template coordinates (px from the centre of the rectangle's first pixel).
class Template {
 public:
  /// Learns the rectangle box (whole pixels) of an 8-bit grey image. Throws std::invalid_argument
  /// that says what to do when the rectangle is not inside the image, is smaller than 16x16 px, or
  /// has too little texture: fewer than kMinKeypoints keypoints (Paper), fewer textured blocks than
  /// the agreement asks for (Detect, Hybrid).
  Template(const cv::Mat& gray, const PixelBox& box, const TrackOptions& options);

  static constexpr int kMinKeypoints = 12;

  const cv::Mat& picture() const { return picture_; }
  double width() const { return picture_.cols; }
  double height() const { return picture_.rows; }
  /// Where the template was in the image it was learned from.
  const PixelBox& box() const { return box_; }

  /// cv::SIFT keypoints and the search tree over their descriptors; only when learned for Paper.
  const Keypoints& keypoints() const { return keypoints_; }
  const Matcher& matcher() const { return *matcher_; }

  /// Keypoints of nine views and the blocks of pixels; only when learned for Detect or Hybrid.
  const LearnedFeatures& features() const { return features_; }
  const TemplateBlocks& blocks() const { return blocks_; }
  /// The blocks under blur, in the order of blurs(); only when learned for Hybrid.
  const std::vector<TemplateBlocks>& blurred() const { return blurred_; }

 private:
  PixelBox box_;
  cv::Mat picture_;
  Keypoints keypoints_;
  std::optional<Matcher> matcher_;
  LearnedFeatures features_;
  TemplateBlocks blocks_;
  std::vector<TemplateBlocks> blurred_;
};

}  // namespace kestrel
