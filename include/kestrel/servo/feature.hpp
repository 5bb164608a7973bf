#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "kestrel/geometry/pixel.hpp"
#include "kestrel/geometry/transform.hpp"

namespace kestrel {

/// An image point and its depth (ViSP: vpFeaturePoint).
struct Feature {
  ImagePoint at;
  double depth_m = 0;  // z in the camera frame, not the distance
};

/// Features of points of the target (m, Target frame) seen from a camera at this pose. The depth of
/// a point behind the camera is negative; the image point of one beside it is not finite.
std::vector<Feature> features(const TargetPose& camera_from_target,
                              const std::array<Eigen::Vector3d, 4>& points_in_target);

/// The features as a camera turned by R would see them: p_turned = R p. With R =
/// level_camera_from_camera(...) these are the features of the levelled camera.
std::vector<Feature> turned(const std::vector<Feature>& features, const Eigen::Matrix3d& R);

/// True when no number of any feature is NaN or infinite.
bool is_finite(const std::vector<Feature>& features);

}  // namespace kestrel
