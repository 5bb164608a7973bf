#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "kestrel/geometry/homography.hpp"
#include "kestrel/geometry/pixel.hpp"
#include "kestrel/vision/simd.hpp"

namespace kestrel {

/// One level of a pyramid: 8-bit grey pixels, of which those of [left, right) x [top, bottom) are
/// there. Pixel (X, Y) of level k covers 2^k x 2^k pixels of level 0.
struct PyramidLevel {
  const std::uint8_t* pixels = nullptr;  // of pixel (0, 0)
  std::ptrdiff_t stride = 0;             // bytes from one row to the next
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;
};

/// The map from pixels of level k to those of level 0: x = 2^k X + (2^k - 1) / 2, since the centre
/// of a pixel of level k lies between those it covers.
Eigen::Matrix3d level0_from_level(int level);

/// A frame at falling resolution, each pixel the mean of four of the level below, rounded. Made
/// where it is looked at only. The memory is kept from frame to frame.
class ImagePyramid {
 public:
  static constexpr int kMaxLevels = 8;

  /// Looks at another frame: 8-bit grey (std::invalid_argument otherwise), whose pixels must
  /// outlive what is done with the pyramid. Makes levels 1 ... levels - 1 of the part of the frame
  /// that the window touches, widened to whole pixels of the coarsest level.
  void look(const cv::Mat& gray, const PixelBox& window, int levels, Simd simd);

  int levels() const { return levels_; }
  const PyramidLevel& level(int k) const { return at_[std::size_t(k)]; }

 private:
  int levels_ = 0;
  std::array<PyramidLevel, kMaxLevels> at_;
  std::array<std::vector<std::uint8_t>, kMaxLevels> memory_;
};

}  // namespace kestrel
