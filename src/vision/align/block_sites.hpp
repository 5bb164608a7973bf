#pragma once

#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

/// Where a template's blocks are cut: places with texture, spread over the picture, that look the
/// same wherever the pixels of a camera lie.
namespace kestrel::blocks {

/// Grey values of a level of a pyramid, row by row.
using Plane = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Differences of grey along both axes, per px of the level.
struct Gradient {
  Plane x;
  Plane y;
};

/// A place for a block and how much it shows.
struct Site {
  int u = 0;
  int v = 0;
  double texture = 0;  // sum of squared gradients
};

/// The levels of a picture's pyramid.
std::vector<Plane> planes(const cv::Mat& picture, int levels);

/// Central differences, one-sided at the border.
Gradient gradient(const Plane& grey);

/// Sites side by side, or, where few of them show anything, each half over the next: an edge along
/// the border of two blocks is in neither.
std::vector<Site> sites(const Plane& grey, const Gradient& g, double noise_grey);

/// The sites with most texture of each cell of a grid of about count cells; what is left of the
/// count goes to the best of the others.
std::vector<Site> spread(std::vector<Site> all, int width, int height, int count);

/// The textured sites of level k that are steady; none when most of what it shows depends on where
/// the pixels lie.
std::vector<Site> steady_sites(const cv::Mat& picture, int k, const Plane& grey, const Gradient& g,
                               double noise_grey);

}  // namespace kestrel::blocks
