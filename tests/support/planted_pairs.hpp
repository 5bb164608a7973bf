#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <Eigen/Core>

#include "kestrel/geometry/homography.hpp"
#include "kestrel/vision/affine_pair.hpp"

#include "support/random.hpp"
#include "support/rendered_view.hpp"

namespace kestrel::test {

/// What a keypoint knows of its neighbourhood's map.
enum class LinearMap { Affine, Similarity };

/// How pairs are planted: noise as detectors have it.
struct PlantedOptions {
  double width_px = 160;
  double height_px = 120;
  int inliers = 30;
  int outliers = 30;
  double noise_px = 0.7;  // of each coordinate in the image
  double log_scale_sigma = 0.15;
  double angle_sigma = 0.17;  // 10 degrees
  LinearMap map = LinearMap::Affine;
  PixelBox image = {0, 0, 640, 480};  // outliers are anywhere in it
};

/// A view of the template somewhere in a frame of 640 x 480, tilted by this much.
inline Homography planted_view(double tilt, const PlantedOptions& o, Random& random) {
  Motion motion;
  motion.scale = std::exp(random.uniform(-0.5, 0.7));
  motion.angle = random.uniform(-M_PI, M_PI);
  motion.tilt = tilt;
  motion.tilt_axis = random.uniform(0, M_PI);
  return moved(motion, {o.width_px / 2, o.height_px / 2},
               {random.uniform(200, 440), random.uniform(150, 330)});
}

/// Derivative of the image of a point by the point, px / px, by central differences.
inline Eigen::Matrix2d local_map(const Homography& H, const Pixel& p) {
  const double step = 1e-3;
  const Pixel r = H * Pixel{p.u + step, p.v};
  const Pixel l = H * Pixel{p.u - step, p.v};
  const Pixel d = H * Pixel{p.u, p.v + step};
  const Pixel a = H * Pixel{p.u, p.v - step};
  Eigen::Matrix2d A;
  A << r.u - l.u, d.u - a.u, r.v - l.v, d.v - a.v;
  return A / (2 * step);
}

/// The similarity nearest to A.
inline Eigen::Matrix2d similarity(const Eigen::Matrix2d& A) {
  const double a = (A(0, 0) + A(1, 1)) / 2;
  const double b = (A(1, 0) - A(0, 1)) / 2;
  Eigen::Matrix2d S;
  S << a, -b, b, a;
  return S;
}

inline Eigen::Matrix2d turn_and_scale(double angle, double log_scale) {
  Eigen::Matrix2d S;
  S << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return S * std::exp(log_scale);
}

inline AffinePair planted_inlier(const Homography& H, const PlantedOptions& o, Random& random) {
  AffinePair pair;
  pair.in_template = {random.uniform(0, o.width_px - 1), random.uniform(0, o.height_px - 1)};
  const Pixel q = H * pair.in_template;
  pair.in_image = {q.u + o.noise_px * random.normal(), q.v + o.noise_px * random.normal()};
  Eigen::Matrix2d A = local_map(H, pair.in_template);
  if (o.map == LinearMap::Similarity) A = similarity(A);
  const double angle = o.angle_sigma * random.normal();
  A = turn_and_scale(angle, o.log_scale_sigma * random.normal()) * A;
  pair.image_from_template = A.cast<float>();
  pair.ratio = float(random.uniform(0.5, 0.9));
  return pair;
}

inline AffinePair planted_outlier(const PlantedOptions& o, Random& random) {
  AffinePair pair;
  pair.in_template = {random.uniform(0, o.width_px - 1), random.uniform(0, o.height_px - 1)};
  pair.in_image = {random.uniform(o.image.u, o.image.u + o.image.width),
                   random.uniform(o.image.v, o.image.v + o.image.height)};
  const double angle = random.uniform(-M_PI, M_PI);
  pair.image_from_template = turn_and_scale(angle, random.uniform(-1.4, 1.4)).cast<float>();
  pair.ratio = float(random.uniform(0.5, 0.9));  // says nothing: the worst case
  return pair;
}

/// The first pairs follow H, the others nothing; template and image indices count up.
inline std::vector<AffinePair> planted(const Homography& H, const PlantedOptions& o,
                                       Random& random) {
  std::vector<AffinePair> pairs;
  pairs.reserve(std::size_t(o.inliers + o.outliers));
  for (int i = 0; i < o.inliers; ++i) pairs.push_back(planted_inlier(H, o, random));
  for (int i = 0; i < o.outliers; ++i) pairs.push_back(planted_outlier(o, random));
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    pairs[i].template_index = pairs[i].image_index = int(i);
  }
  return pairs;
}

/// The same pairs in another order.
inline std::vector<AffinePair> shuffled(std::vector<AffinePair> pairs, Random& random) {
  for (std::size_t i = pairs.size(); i > 1; --i) {
    std::swap(pairs[i - 1], pairs[std::size_t(random.integer(0, int(i) - 1))]);
  }
  return pairs;
}

}  // namespace kestrel::test
