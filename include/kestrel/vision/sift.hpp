#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "kestrel/geometry/pixel.hpp"
#include "kestrel/vision/simd.hpp"

namespace kestrel {

/// RootSIFT (Arandjelovic & Zisserman 2012) in 7 bits: round(256 sqrt(bin / sum of bins)), at most
/// 127. Bins are ordered as cv::SIFT orders them: 4 rows of 4 cells, 8 orientations each.
struct Descriptor {
  alignas(32) std::array<std::uint8_t, 128> bin{};
};

/// A keypoint of an image.
struct SiftPoint {
  float u = 0;          // px, sub-pixel, in the whole image
  float v = 0;          // px
  float scale_px = 0;   // standard deviation of the Gaussian it was found at
  float angle_rad = 0;  // of the strongest gradient, from u towards v, in [0, 2 pi)
  float response = 0;   // |difference of Gaussians|, of a full scale of 1
};

/// Keypoints and, in the same order, what they look like.
struct SiftPoints {
  std::vector<SiftPoint> at;
  std::vector<Descriptor> descriptors;
};

/// Most keypoints FastSift can be asked for.
constexpr int kMaxSiftPoints = 8000;

/// Parameters of the detector (Lowe 2004).
struct FastSiftOptions {
  int octave_layers = 3;
  double contrast_threshold = 0.04;  // as cv::SIFT: of octave_layers times the response
  double edge_threshold = 10;        // largest ratio of principal curvatures
  double sigma = 1.6;                // px, of the first level
  bool is_doubled = false;           // described from a copy enlarged twice: four times the time
  int max_keypoints = 1000;          // the strongest; bounds the time of a frame
  Simd simd = Simd::Auto;

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// SIFT detector (Lowe 2004) that keeps its memory from image to image. Unlike cv::SIFT it does not
/// enlarge the image unless asked to, and its keypoints are not shifted by a quarter of a pixel.
/// The same image gives the same bits, whatever the processor and whatever was seen before.
class FastSift {
 public:
  /// Throws std::invalid_argument for options out of range.
  explicit FastSift(const FastSiftOptions& options);
  ~FastSift();
  FastSift(FastSift&&) noexcept;
  FastSift& operator=(FastSift&&) noexcept;

  /// Keypoints of the part of an 8-bit grey image inside window, in coordinates of the image; the
  /// window is cut to the image and what lies around it is not looked at. In the order octave, row,
  /// layer, column; at most max_keypoints. Empty for an empty image or window and for a window too
  /// small to hold a keypoint (11 px). Throws std::invalid_argument for an image that is not 8-bit
  /// grey. Valid until the next call; no allocation for windows no larger than before.
  const SiftPoints& detect(const cv::Mat& gray, const PixelBox& window);

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace kestrel
