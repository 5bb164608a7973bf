#pragma once

#include <array>

#include <Eigen/Core>

#include "kernels.hpp"
#include "pyramid.hpp"

namespace kestrel::sim_detail {

/// A plane as one pose sees it.
struct SeenPlane {
  const Pyramid* texture = nullptr;
  Eigen::Matrix3f texture_from_ray;  // (s, t, 1) / depth of a ray (x, y, 1), s and t in texels
  float opacity = 1;
};

/// How much of some pixels a plane covers.
enum class Extent { None, Part, All };

/// Of what lies between four rays; Part also where the rays are no numbers.
Extent extent(const SeenPlane& plane, const std::array<Eigen::Vector3f, 4>& rays);

/// Whether 1 / depth differs so little between the rays that one footprint is good for all: by 6 %,
/// which makes 12 % of length where the plane is seen at a slant.
bool is_even(const SeenPlane& plane, const std::array<Eigen::Vector3f, 4>& rays);

/// A pixel on the texture: a parallelogram with sides (sa, ta), one pixel to the right, and
/// (sb, tb), one pixel down; texels.
struct Footprint {
  float sa = 0;
  float ta = 0;
  float sb = 0;
  float tb = 0;
};

/// Of the pixel with this ray, by those to its right and below. Not finite where one is no number.
Footprint footprint(const SeenPlane& plane, const Eigen::Vector3f& ray,
                    const Eigen::Vector3f& right, const Eigen::Vector3f& below);

}  // namespace kestrel::sim_detail
