#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

#include "kestrel/geometry/pixel.hpp"

namespace kestrel {

/// Parameters of the SIFT detector (Lowe 2004).
struct SiftOptions {
  int octave_layers = 3;
  double contrast_threshold = 0.04;
  double edge_threshold = 10;
  double sigma = 1.6;
  int max_keypoints = 2000;  // the strongest; bounds the time of a frame

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// SIFT keypoints of an image: where, and a row of 128 floats each.
struct Keypoints {
  std::vector<Pixel> at;  // px, sub-pixel, in the whole image
  cv::Mat descriptors;    // at.size() x 128, CV_32F
};

/// SIFT keypoints of the part of an 8-bit grey image inside window, in coordinates of the image.
/// cv::SIFT of OpenCV 4.6 places keypoints 0.25 px too far right and down (its doubling of the
/// image); that is taken off here. Empty for a window smaller than 8x8 px.
Keypoints detect_keypoints(const cv::Mat& gray, const PixelBox& window, const SiftOptions& options);

}  // namespace kestrel
