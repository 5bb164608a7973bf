#include "kestrel/vision/template_blocks.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include <Eigen/LU>
#include <opencv2/core.hpp>

#include "kestrel/vision/image_pyramid.hpp"

#include "align/block_kernels.hpp"
#include "align/block_sites.hpp"

namespace kestrel {
namespace {

constexpr int kSide = kernel::kBlockSide;
constexpr int kPixels = kernel::kBlockPixels;

/// Below this a level holds no more than one block a side: too few to tell which of them to trust.
constexpr int kMinLevelSidePx = 12;

using blocks::Gradient;
using blocks::Plane;
using blocks::Site;
using Derivatives = Eigen::Matrix<double, kPixels, 8>;
using Texture = Eigen::Matrix<double, kPixels, 1>;

/// Derivatives of the block's pixels by the parameters of warp().
Derivatives derivatives(const Gradient& g, const Site& site, const Eigen::Matrix3d& scaled) {
  const double per_px = scaled(0, 0);
  Derivatives J;
  for (int i = 0; i < kPixels; ++i) {
    const int u = site.u + i % kSide;
    const int v = site.v + i / kSide;
    const double x = scaled(0, 0) * u + scaled(0, 2);
    const double y = scaled(1, 1) * v + scaled(1, 2);
    const double gx = double(g.x(v, u)) / per_px;
    const double gy = double(g.y(v, u)) / per_px;
    const double radial = gx * x + gy * y;
    J.row(i) << gx, gy, radial, gy * x - gx * y, gx * x - gy * y, gx * y + gy * x, -x * radial,
        -y * radial;
  }
  return J;
}

/// Without what a change of gain or bias could explain.
Derivatives projected(Derivatives J, const Texture& texture) {
  J.rowwise() -= J.colwise().mean().eval();
  const double norm2 = texture.squaredNorm();
  J -= texture * (texture.transpose() * J).eval() / norm2;
  return J;
}

void append(const Plane& grey, const Gradient& g, const Site& site, const Eigen::Matrix3d& scaled,
            BlockLevel& level) {
  Texture texture;
  for (int i = 0; i < kPixels; ++i) {
    texture[i] = grey(site.v + i / kSide, site.u + i % kSide);
  }
  texture.array() -= texture.mean();
  const Derivatives J = projected(derivatives(g, site, scaled), texture);
  TemplateBlock block;
  block.u = site.u;
  block.v = site.v;
  block.texture_norm2 = texture.squaredNorm();
  block.information = J.transpose() * J;
  level.blocks.push_back(block);
  for (int i = 0; i < kPixels; ++i) level.textures.push_back(float(texture[i]));
  for (int p = 0; p < 8; ++p) {
    for (int i = 0; i < kPixels; ++i) level.derivatives.push_back(float(J(i, p)));
  }
}

int level_count(int width, int height) {
  int levels = 1;
  while (levels < ImagePyramid::kMaxLevels &&
         (std::min(width, height) >> levels) >= kMinLevelSidePx) {
    ++levels;
  }
  return levels;
}

void require(bool holds, const char* message) {
  if (!holds) throw std::invalid_argument(message);
}

/// All levels, each at those of the sites that choose(k, grey, gradient) names.
template <typename Choose>
TemplateBlocks cut(const cv::Mat& picture, const BlockOptions& options, const Choose& choose) {
  options.check();
  require(!picture.empty() && picture.type() == CV_8UC1 &&
              std::min(picture.cols, picture.rows) >= kSide,
          "picture: must be 8-bit grey and at least 8x8 px");
  TemplateBlocks result;
  result.width = picture.cols;
  result.height = picture.rows;
  result.options = options;
  const Eigen::Matrix3d scaled = scaled_from_template(picture.cols, picture.rows);
  const std::vector<Plane> all = blocks::planes(picture, level_count(picture.cols, picture.rows));
  for (int k = 0; k < int(all.size()); ++k) {
    const Plane& grey = all[std::size_t(k)];
    const Gradient g = blocks::gradient(grey);
    BlockLevel level;
    level.width = int(grey.cols());
    level.height = int(grey.rows());
    const int most = k == 0 ? options.max_blocks : options.max_coarse_blocks;
    for (const Site& site : blocks::spread(choose(k, grey, g), level.width, level.height, most)) {
      append(grey, g, site, scaled * level0_from_level(k), level);
    }
    result.levels.push_back(std::move(level));
  }
  return result;
}

}  // namespace

void BlockOptions::check() const {
  require(max_blocks >= 4, "blocks.max_blocks: must be at least 4");
  require(max_coarse_blocks >= 4, "blocks.max_coarse_blocks: must be at least 4");
  require(noise_grey > 0 && noise_grey <= 64, "blocks.noise_grey: must be above 0 and at most 64");
  require(model_error >= 0 && model_error <= 1, "blocks.model_error: must be 0 to 1");
}

Eigen::Matrix3d warp(const Vector8d& p) {
  Eigen::Matrix3d W;
  W << 1 + p[2] + p[4], p[5] - p[3], p[0],  //
      p[3] + p[5], 1 + p[2] - p[4], p[1],   //
      p[6], p[7], 1;
  return W;
}

Eigen::Matrix3d scaled_from_template(double width_px, double height_px) {
  const double half = std::max(width_px, height_px) / 2;
  Eigen::Matrix3d S;
  S << 1 / half, 0, -(width_px - 1) / (2 * half),  //
      0, 1 / half, -(height_px - 1) / (2 * half),  //
      0, 0, 1;
  return S;
}

TemplateBlocks template_blocks(const cv::Mat& picture, const BlockOptions& options) {
  return cut(picture, options, [&](int k, const Plane& grey, const Gradient& g) {
    return blocks::steady_sites(picture, k, grey, g, options.noise_grey);
  });
}

TemplateBlocks template_blocks(const cv::Mat& picture, const BlockOptions& options,
                               const TemplateBlocks& sharp) {
  require(picture.cols == sharp.width && picture.rows == sharp.height,
          "picture: must be as large as the sharp one");
  return cut(picture, options, [&](int k, const Plane& grey, const Gradient& g) {
    return sharp.levels[std::size_t(k)].blocks.empty() ? std::vector<Site>()
                                                       : blocks::sites(grey, g, options.noise_grey);
  });
}

}  // namespace kestrel
