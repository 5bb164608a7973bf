#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "kestrel/geometry/pixel.hpp"

namespace kestrel {

/// Homography of at least four pairs of normalised image points, b ~ H a: exact for four, least
/// squares for more (see fit_homography), scaled to be Euclidean. Empty for lists that are not
/// equally long and where fit_homography or euclidean_homography is.
std::optional<Eigen::Matrix3d> point_homography(const std::vector<ImagePoint>& a,
                                                const std::vector<ImagePoint>& b);

/// The homography of a plane in the scale and sign of H = R + t n^T / d (Faugeras & Lustman 1988):
/// its second singular value is 1, and the points a of the first image are in front of both
/// cameras, so that (H a)_3 is depth in b over depth in a. Empty when H is not finite or of rank
/// two, or when it takes the points to both sides of the second camera.
std::optional<Eigen::Matrix3d> euclidean_homography(const Eigen::Matrix3d& H,
                                                    const std::vector<ImagePoint>& a);

}  // namespace kestrel
