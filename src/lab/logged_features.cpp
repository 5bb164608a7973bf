#include "kestrel/lab/logged_features.hpp"

#include <algorithm>

#include "kestrel/geometry/attitude.hpp"

namespace kestrel {
namespace {

/// Takes vectors of the camera into the levelled camera.
Eigen::Matrix3d levelling(const LogRow& row, const Task& task) {
  if (!row.attitude) return Eigen::Matrix3d::Identity();
  return level_camera_from_camera(task.body_from_camera.rotation, *row.attitude);
}

/// Whether the row's error is that of the four corners; the error of a law with features of its own
/// is not logged.
bool has_corner_error(const LogRow& row) {
  const auto& e = row.servo->error;
  const bool is_zero = std::all_of(e.begin(), e.end(), [](double x) { return x == 0; });
  return !is_zero || row.servo->error_norm == 0;
}

}  // namespace

std::vector<Feature> logged_features(const LogRow& row, const Task& task) {
  if (!row.pose || !row.servo) return {};
  const TargetPose pose{rotation_from_vector(row.pose->rotation_rad), row.pose->translation_m};
  std::vector<Feature> seen = features(pose, target_corners(task));
  if (!has_corner_error(row)) return seen;
  const std::vector<Feature> desired = desired_features(task);
  const Eigen::Matrix3d to_camera = levelling(row, task).transpose();
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const Eigen::Vector3d ray =
        to_camera * Eigen::Vector3d(desired[i].at.x + row.servo->error[2 * i],
                                    desired[i].at.y + row.servo->error[2 * i + 1], 1);
    seen[i].at = {ray.x() / ray.z(), ray.y() / ray.z()};
  }
  return seen;
}

std::vector<Feature> logged_levelled_features(const LogRow& row, const Task& task) {
  return turned(logged_features(row, task), levelling(row, task));
}

Mount levelled_mount(const LogRow& row, const Task& task) {
  const Mount& mount = task.body_from_camera;
  if (!row.attitude) return mount;
  return {mount.rotation, level_from_body(*row.attitude) * mount.translation};
}

}  // namespace kestrel
