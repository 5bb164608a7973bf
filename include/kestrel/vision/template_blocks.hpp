#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

namespace kestrel {

using Matrix8d = Eigen::Matrix<double, 8, 8>;
using Vector8d = Eigen::Matrix<double, 8, 1>;

/// How the template is cut into blocks.
struct BlockOptions {
  int max_blocks = 96;  // of the finest level: bounds the time of a frame
  int max_coarse_blocks =
      40;                 // of each other level, which need only lead into the next one's range
  double noise_grey = 2;  // standard deviation of a pixel; a block that varies less shows nothing
  double model_error =
      0.1;  // what gain and bias leave unexplained, as a share of a block's contrast

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// 8x8 px of one level of the template.
struct TemplateBlock {
  double u = 0;  // first pixel, px of the level
  double v = 0;
  double texture_norm2 = 0;  // sum of squares of the pixels less their mean
  Matrix8d information;      // sum over the pixels of derivative times derivative transposed
};

/// One level of the template: its blocks, and for each of them one after another 64 pixels less
/// their mean, and eight times 64 derivatives of its pixels by the parameters of warp(). Gain and
/// bias are projected out of the derivatives: their product with the pixels an image shows does not
/// change with its brightness, and vanishes where the image is the template.
struct BlockLevel {
  int width = 0;  // px of the level
  int height = 0;
  std::vector<TemplateBlock> blocks;
  std::vector<float> textures;
  std::vector<float> derivatives;
};

/// A template cut into blocks at falling resolution.
struct TemplateBlocks {
  double width = 0;  // px of level 0
  double height = 0;
  BlockOptions options;            // it was cut with
  std::vector<BlockLevel> levels;  // 0: full resolution
};

/// Small projective motion of the template in itself, in coordinates x, y of scaled(): translation
/// (p0, p1), scale p2, rotation p3, the two ways to squeeze (p4, p5), perspective (p6, p7); the
/// identity for zero. det = 1 + O(p).
Eigen::Matrix3d warp(const Vector8d& parameters);

/// The map from template px to the coordinates of warp(): origin at the centre, the longer side
/// from -1 to 1.
Eigen::Matrix3d scaled_from_template(double width_px, double height_px);

/// Cuts an 8-bit grey picture, at least 8x8 px, into blocks: at each level those with most texture,
/// spread over the picture.
TemplateBlocks template_blocks(const cv::Mat& picture, const BlockOptions& options);

/// The same for a picture that shows a sharp one with less detail, of its size: only the levels at
/// which that one has blocks, since what the sharp one shows steadily, less detail does too.
/// Whether it does is not looked at again, which takes most of the time.
TemplateBlocks template_blocks(const cv::Mat& picture, const BlockOptions& options,
                               const TemplateBlocks& sharp);

}  // namespace kestrel
