#pragma once

#include <array>
#include <optional>

#include <Eigen/Core>

#include "kestrel/geometry/camera.hpp"

namespace kestrel {

/// A lens as a block of the template meets it.
class BlockLens {
 public:
  explicit BlockLens(const Camera& camera);

  /// The affine map, px to px, that the lens is nearest to at four pixels of the camera without
  /// one, the corners of a small quadrangle in order. Empty where the lens shows one of them
  /// nowhere, or they lie on a line.
  std::optional<Eigen::Matrix3d> image_from_straight(const std::array<Pixel, 4>& straight) const;

 private:
  Camera camera_;
  Camera pinhole_;
};

}  // namespace kestrel
