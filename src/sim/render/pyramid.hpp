#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace kestrel::sim_detail {

/// The texture at one scale, ready to be read.
struct Level {
  /// Its edge repeated, so that what is read beyond needs no test. Of the texture itself each
  /// element is a column of four texels, from the one above on: the 4x4 around a place lie in one
  /// piece.
  cv::Mat grey;
  float per_texel_s = 1;  // texels of this level per texel of the texture
  float per_texel_t = 1;
  float first = 0;   // where the first value lies: 0.5 in a texel's centre, 0 on the outer edge
  float last_s = 0;  // from the first value to the last one
  float last_t = 0;
};

constexpr int kLevelsPerOctave = 4;

/// A texture and its means.
class Pyramid {
 public:
  explicit Pyramid(const cv::Mat& texture);

  float width() const { return float(texture_.cols); }  // texels
  float height() const { return float(texture_.rows); }

  /// The texture itself.
  const Level& sharp() const { return sharp_; }

  /// Means over 2x2 texels: of the texture for level 0, each next one 2^(1/4) coarser. One bilinear
  /// tap of the level whose two texels span a pixel best is then the mean over the pixel, within 9
  /// % of its width, and edges stay where they are, also when they run along a row of pixels. (Taps
  /// of unaveraged texels would shift such edges by up to 0.1 px.) An index beyond the last level
  /// is that one. Made when it is first asked for: of most textures few scales are ever seen. By
  /// any thread, the same bytes.
  const Level& mean(int index) const;

 private:
  /// A scale that has been asked for.
  struct Scale {
    std::once_flag pictured;
    std::once_flag averaged;
    cv::Mat picture;  // 16 bits
    Level mean;
  };

  const cv::Mat& picture(int index) const;

  cv::Mat texture_;
  Level sharp_;
  std::unique_ptr<std::vector<Scale>> scales_;
};

}  // namespace kestrel::sim_detail
