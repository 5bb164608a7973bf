#include "kestrel/servo/feature.hpp"

#include <algorithm>
#include <cmath>

namespace kestrel {
namespace {

Feature project(const Eigen::Vector3d& p_in_camera) {
  return {{p_in_camera.x() / p_in_camera.z(), p_in_camera.y() / p_in_camera.z()}, p_in_camera.z()};
}

}  // namespace

std::vector<Feature> features(const TargetPose& camera_from_target,
                              const std::array<Eigen::Vector3d, 4>& points_in_target) {
  std::vector<Feature> seen;
  seen.reserve(points_in_target.size());
  for (const Eigen::Vector3d& p : points_in_target) seen.push_back(project(camera_from_target * p));
  return seen;
}

std::vector<Feature> turned(const std::vector<Feature>& features, const Eigen::Matrix3d& R) {
  std::vector<Feature> seen;
  seen.reserve(features.size());
  for (const Feature& f : features) {
    seen.push_back(project(R * (f.depth_m * Eigen::Vector3d(f.at.x, f.at.y, 1))));
  }
  return seen;
}

bool is_finite(const std::vector<Feature>& features) {
  return std::all_of(features.begin(), features.end(), [](const Feature& f) {
    return std::isfinite(f.at.x) && std::isfinite(f.at.y) && std::isfinite(f.depth_m);
  });
}

}  // namespace kestrel
