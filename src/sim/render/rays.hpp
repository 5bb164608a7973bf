#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/types.hpp>

#include "kestrel/geometry/camera.hpp"

namespace kestrel::sim_detail {

/// Pixels that are worked on together: side by side in a row, so that the compiler can.
constexpr int kRun = 16;
using Run = std::array<float, kRun>;

/// Pixels of the picture that are looked at together: a run, and this many rows.
struct Tile {
  int u = 0;  // of the first pixel
  int v = 0;
  int rows = 0;  // at most kRun
};

/// Through which points of the normalised image plane the pixels look, with one column and one row
/// more than there are pixels. Not numbers where the lens lets no light in.
class Rays {
 public:
  explicit Rays(const Camera& camera)
      : size_(camera.parameters().width, camera.parameters().height),
        xy_(std::size_t(size_.width / kRun + 1) * std::size_t(size_.height + 1) * 2 * kRun) {
    for (int v = 0; v <= size_.height; ++v) {
      for (int u = 0; u < (size_.width / kRun + 1) * kRun; ++u) {
        const ImagePoint p = camera.to_image_point({double(u), double(v)});
        xy_[index(u, v)] = float(p.x);
        xy_[index(u, v) + kRun] = float(p.y);
      }
    }
  }

  cv::Size size() const { return size_; }
  /// The run's x, then its y, then those of the run below; u is a multiple of kRun.
  const float* run(int u, int v) const { return &xy_[index(u, v)]; }

  /// (x, y, 1) of a pixel; of one left of or above the picture by going on straight.
  Eigen::Vector3f ray(int u, int v) const {
    if (u < 0) return 2 * ray(0, v) - ray(-u, v);
    if (v < 0) return 2 * ray(u, 0) - ray(u, -v);
    return {xy_[index(u, v)], xy_[index(u, v) + kRun], 1};
  }

  /// Around the squares of the tile's pixels: half a pixel beyond them, for what a lens bends
  /// within a tile.
  std::array<Eigen::Vector3f, 4> corners(const Tile& tile) const {
    const int right = std::min(tile.u + kRun, size_.width);
    const int bottom = std::min(tile.v + tile.rows, size_.height);
    return {ray(tile.u - 1, tile.v - 1), ray(right, tile.v - 1), ray(tile.u - 1, bottom),
            ray(right, bottom)};
  }

 private:
  std::size_t index(int u, int v) const {
    const auto row = std::size_t(u / kRun) * std::size_t(size_.height + 1) + std::size_t(v);
    return row * 2 * kRun + std::size_t(u % kRun);
  }

  cv::Size size_;
  std::vector<float> xy_;  // of the width and one more in whole runs, each from top to bottom
};

}  // namespace kestrel::sim_detail
