#include "kestrel/vision/template_blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

#include <Eigen/LU>
#include <opencv2/core.hpp>

#include "kestrel/vision/image_pyramid.hpp"

#include "align/block_kernels.hpp"

namespace kestrel {
namespace {

constexpr int kSide = kernel::kBlockSide;
constexpr int kPixels = kernel::kBlockPixels;

/// Below this a level holds no more than one block a side: too few to tell which of them to trust.
constexpr int kMinLevelSidePx = 12;

/// Correlation at which two pictures share half their variance.
constexpr double kSteady = 0.7071;

using Plane = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Derivatives = Eigen::Matrix<double, kPixels, 8>;
using Texture = Eigen::Matrix<double, kPixels, 1>;

Plane plane(const PyramidLevel& level) {
  Plane grey(level.bottom, level.right);
  for (int y = 0; y < level.bottom; ++y) {
    for (int x = 0; x < level.right; ++x) grey(y, x) = level.pixels[y * level.stride + x];
  }
  return grey;
}

/// Difference across two pixels, one at the border, px of the level.
float slope(float before, float after, int steps) {
  return (after - before) / float(std::max(steps, 1));
}

struct Gradient {
  Plane x;
  Plane y;
};

Gradient gradient(const Plane& grey) {
  const int rows = int(grey.rows());
  const int cols = int(grey.cols());
  Gradient g{Plane(rows, cols), Plane(rows, cols)};
  for (int y = 0; y < rows; ++y) {
    const int above = std::max(y - 1, 0);
    const int below = std::min(y + 1, rows - 1);
    for (int x = 0; x < cols; ++x) {
      const int left = std::max(x - 1, 0);
      const int right = std::min(x + 1, cols - 1);
      g.x(y, x) = slope(grey(y, left), grey(y, right), right - left);
      g.y(y, x) = slope(grey(above, x), grey(below, x), below - above);
    }
  }
  return g;
}

/// A place for a block and how much it shows.
struct Site {
  int u = 0;
  int v = 0;
  double texture = 0;  // sum of squared gradients
};

/// First pixels of blocks from 0 to length - kSide, evenly spread, a step or a little less apart.
std::vector<int> starts(int length, int step) {
  const int count = (length - kSide + step - 1) / step + 1;
  std::vector<int> result;
  result.reserve(std::size_t(count));
  for (int i = 0; i < count; ++i) {
    result.push_back(count == 1 ? 0 : (i * (length - kSide) + (count - 1) / 2) / (count - 1));
  }
  return result;
}

double norm2(const Plane& grey, int u, int v) {
  const auto block = grey.block<kSide, kSide>(v, u).cast<double>();
  return (block - block.mean()).square().sum();
}

/// Where there is more texture than noise, of a grid of this step.
std::vector<Site> sites(const Plane& grey, const Gradient& g, double noise_grey, int step) {
  const double least = kPixels * noise_grey * noise_grey;
  std::vector<Site> result;
  for (const int v : starts(int(grey.rows()), step)) {
    for (const int u : starts(int(grey.cols()), step)) {
      if (norm2(grey, u, v) <= 2 * least) continue;  // as much noise as texture
      const double texture = (g.x.block<kSide, kSide>(v, u).square().sum()) +
                             double(g.y.block<kSide, kSide>(v, u).square().sum());
      result.push_back({u, v, texture});
    }
  }
  return result;
}

/// Sites side by side, or, where few of them show anything, each half over the next: an edge along
/// the border of two blocks is in neither.
std::vector<Site> sites(const Plane& grey, const Gradient& g, double noise_grey) {
  std::vector<Site> apart = sites(grey, g, noise_grey, kSide);
  const std::size_t all =
      starts(int(grey.rows()), kSide).size() * starts(int(grey.cols()), kSide).size();
  return 4 * apart.size() >= all ? apart : sites(grey, g, noise_grey, kSide / 2);
}

/// The sites with most texture of each cell of a grid of about count cells; what is left of the
/// count goes to the best of the others.
std::vector<Site> spread(std::vector<Site> all, int width, int height, int count) {
  if (int(all.size()) <= count) return all;
  const double cell = std::sqrt(double(width) * height / count);
  const int columns = int(std::ceil(width / cell));
  const auto cell_of = [&](const Site& s) {
    constexpr int kHalf = kSide / 2;
    return int((s.v + kHalf) / cell) * columns + int((s.u + kHalf) / cell);
  };
  std::stable_sort(all.begin(), all.end(),
                   [](const Site& a, const Site& b) { return a.texture > b.texture; });
  std::vector<bool> taken(std::size_t(columns) * std::size_t(std::ceil(height / cell) + 1), false);
  const auto others = std::stable_partition(all.begin(), all.end(), [&](const Site& s) {
    const auto c = std::size_t(cell_of(s));
    const bool first = !taken[c];
    taken[c] = true;
    return first;
  });
  (void)others;  // still the most textured first
  all.resize(std::size_t(count));
  return all;
}

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

/// The levels of a picture's pyramid.
std::vector<Plane> planes(const cv::Mat& picture, int levels) {
  ImagePyramid pyramid;
  pyramid.look(picture, {0, 0, double(picture.cols), double(picture.rows)}, levels, Simd::Auto);
  std::vector<Plane> result;
  result.reserve(std::size_t(levels));
  for (int k = 0; k < levels; ++k) result.push_back(plane(pyramid.level(k)));
  return result;
}

/// Level k as it is seen where the pixels of a camera lie half a pixel of that level to the right,
/// below or both, and interpolated back: where that is another picture, the level shows a beat of
/// the texture with the pixels, not the texture.
std::vector<Plane> off_grid(const cv::Mat& picture, int k) {
  const int half = 1 << (k - 1);
  std::vector<Plane> result;
  for (const auto& [du, dv] : {std::pair(half, 0), std::pair(0, half), std::pair(half, half)}) {
    cv::Mat moved;
    cv::copyMakeBorder(picture, moved, dv, 0, du, 0, cv::BORDER_REPLICATE);
    const Plane seen = planes(moved, k + 1).back();
    const int rows = picture.rows >> k;
    const int cols = picture.cols >> k;
    const int below = dv > 0 ? 1 : 0;
    const int right = du > 0 ? 1 : 0;
    Plane back(rows, cols);
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < cols; ++x) {
        const int y1 = std::min(y + below, int(seen.rows()) - 1);
        const int x1 = std::min(x + right, int(seen.cols()) - 1);
        back(y, x) = (seen(y, x) + seen(y1, x) + seen(y, x1) + seen(y1, x1)) / 4;
      }
    }
    result.push_back(std::move(back));
  }
  return result;
}

/// Zero-mean normalised cross-correlation of a block of two pictures.
double correlation(const Plane& a, const Plane& b, const Site& site) {
  const auto block = [&](const Plane& grey) {
    Eigen::ArrayXXd pixels = grey.block<kSide, kSide>(site.v, site.u).cast<double>();
    pixels -= pixels.mean();
    return pixels;
  };
  const Eigen::ArrayXXd p = block(a);
  const Eigen::ArrayXXd q = block(b);
  const double norm = std::sqrt(p.square().sum() * q.square().sum());
  return norm > 0 ? (p * q).sum() / norm : 0;
}

/// Sites of a coarse level that look the same, up to half their variance, wherever the pixels lie.
std::vector<Site> steady(const std::vector<Site>& all, const Plane& grey,
                         const std::vector<Plane>& others) {
  std::vector<Site> result;
  std::copy_if(all.begin(), all.end(), std::back_inserter(result), [&](const Site& site) {
    return std::all_of(others.begin(), others.end(), [&](const Plane& other) {
      return correlation(grey, other, site) > kSteady;
    });
  });
  return result;
}

/// The textured sites of level k that are steady; none when most of what it shows depends on where
/// the pixels lie.
std::vector<Site> steady_sites(const cv::Mat& picture, int k, const Plane& grey, const Gradient& g,
                               double noise_grey) {
  std::vector<Site> textured = sites(grey, g, noise_grey);
  if (k == 0) return textured;
  const std::vector<Site> kept = steady(textured, grey, off_grid(picture, k));
  return 2 * kept.size() < textured.size() ? std::vector<Site>() : kept;
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
  const std::vector<Plane> all = planes(picture, level_count(picture.cols, picture.rows));
  for (int k = 0; k < int(all.size()); ++k) {
    const Plane& grey = all[std::size_t(k)];
    const Gradient g = gradient(grey);
    BlockLevel level;
    level.width = int(grey.cols());
    level.height = int(grey.rows());
    const int most = k == 0 ? options.max_blocks : options.max_coarse_blocks;
    for (const Site& site : spread(choose(k, grey, g), level.width, level.height, most)) {
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
    return steady_sites(picture, k, grey, g, options.noise_grey);
  });
}

TemplateBlocks template_blocks(const cv::Mat& picture, const BlockOptions& options,
                               const TemplateBlocks& sharp) {
  require(picture.cols == sharp.width && picture.rows == sharp.height,
          "picture: must be as large as the sharp one");
  return cut(picture, options, [&](int k, const Plane& grey, const Gradient& g) {
    return sharp.levels[std::size_t(k)].blocks.empty() ? std::vector<Site>()
                                                       : sites(grey, g, options.noise_grey);
  });
}

}  // namespace kestrel
