#include "block_sites.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <opencv2/core.hpp>

#include "kestrel/vision/image_pyramid.hpp"

#include "block_kernels.hpp"

namespace kestrel::blocks {
namespace {

constexpr int kSide = kernel::kBlockSide;
constexpr int kPixels = kernel::kBlockPixels;

/// Correlation at which two pictures share half their variance.
constexpr double kSteady = 0.7071;

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
std::vector<Site> sites_apart(const Plane& grey, const Gradient& g, double noise_grey, int step) {
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

}  // namespace

std::vector<Plane> planes(const cv::Mat& picture, int levels) {
  ImagePyramid pyramid;
  pyramid.look(picture, {0, 0, double(picture.cols), double(picture.rows)}, levels, Simd::Auto);
  std::vector<Plane> result;
  result.reserve(std::size_t(levels));
  for (int k = 0; k < levels; ++k) result.push_back(plane(pyramid.level(k)));
  return result;
}

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

std::vector<Site> sites(const Plane& grey, const Gradient& g, double noise_grey) {
  std::vector<Site> apart = sites_apart(grey, g, noise_grey, kSide);
  const std::size_t all =
      starts(int(grey.rows()), kSide).size() * starts(int(grey.cols()), kSide).size();
  return 4 * apart.size() >= all ? apart : sites_apart(grey, g, noise_grey, kSide / 2);
}

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

std::vector<Site> steady_sites(const cv::Mat& picture, int k, const Plane& grey, const Gradient& g,
                               double noise_grey) {
  std::vector<Site> textured = sites(grey, g, noise_grey);
  if (k == 0) return textured;
  const std::vector<Site> kept = steady(textured, grey, off_grid(picture, k));
  return 2 * kept.size() < textured.size() ? std::vector<Site>() : kept;
}

}  // namespace kestrel::blocks
