#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

namespace kestrel {

/// What kestrel_images.so gives: OpenCV's image files of every kind, behind which stand two hundred
/// libraries.
struct ImageModule {
  /// cv::imdecode, the pixels as stored; empty for what is no image.
  cv::Mat (*decode)(const std::vector<unsigned char>& bytes);
};

}  // namespace kestrel
