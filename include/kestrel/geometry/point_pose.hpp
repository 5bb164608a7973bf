#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "kestrel/geometry/pixel.hpp"
#include "kestrel/geometry/transform.hpp"

namespace kestrel {

/// Pose of a target from n known points (m, Target) and where the camera sees them (normalised,
/// same order): the least squares of the image points by Gauss-Newton on SE(3), at most 15 steps,
/// whose Jacobian is the interaction matrix of the points (virtual visual servoing, Comport,
/// Marchand & Chaumette 2006). It starts at `previous`; without one, or when nothing comes of it,
/// at the homography of the points' plane (n >= 4, in any plane of Target) or, for points in no
/// plane, at the linear solution (n >= 6, Abdel-Aziz & Karara 1971). It finds the minimum at its
/// start: which of the two of a nearly affine view that is, plane_pose can tell. Empty for lists
/// not equally long, fewer than three points or three without `previous`, points on a line, numbers
/// that are not finite, no start, or a pose that puts a point behind the camera.
std::optional<TargetPose> point_pose(const std::vector<Eigen::Vector3d>& points_in_target,
                                     const std::vector<ImagePoint>& seen,
                                     const std::optional<TargetPose>& previous = std::nullopt);

}  // namespace kestrel
