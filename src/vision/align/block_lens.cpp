#include "block_lens.hpp"

#include <cmath>

#include <Eigen/LU>

#include "kestrel/geometry/straight_view.hpp"

namespace kestrel {
namespace {

/// Middle and sides of a quadrangle.
struct Quadrangle {
  Eigen::Vector2d middle;
  Eigen::Matrix2d sides;  // columns: along the first side, along the second, opposite ones in mean
};

Quadrangle quadrangle(const std::array<Pixel, 4>& corners) {
  const auto at = [&](std::size_t i) { return Eigen::Vector2d(corners[i].u, corners[i].v); };
  Quadrangle q;
  q.middle = (at(0) + at(1) + at(2) + at(3)) / 4;
  q.sides << (at(1) - at(0) + at(2) - at(3)) / 2, (at(3) - at(0) + at(2) - at(1)) / 2;
  return q;
}

}  // namespace

BlockLens::BlockLens(const Camera& camera) : camera_(camera), pinhole_(without_lens(camera)) {}

std::optional<Eigen::Matrix3d> BlockLens::image_from_straight(
    const std::array<Pixel, 4>& straight) const {
  std::array<Pixel, 4> seen = straight;
  for (Pixel& p : seen) p = camera_.to_pixel(pinhole_.to_image_point(p));
  const Quadrangle from = quadrangle(straight);
  const Quadrangle to = quadrangle(seen);
  const Eigen::Matrix2d J = to.sides * from.sides.inverse();
  Eigen::Matrix3d bend = Eigen::Matrix3d::Identity();
  bend.topLeftCorner<2, 2>() = J;
  bend.topRightCorner<2, 1>() = to.middle - J * from.middle;
  if (!bend.allFinite()) return std::nullopt;
  return bend;
}

}  // namespace kestrel
