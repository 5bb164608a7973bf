#include "kestrel/loop/task.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "kestrel/geometry/rotation.hpp"

namespace kestrel {
namespace {

/// The most by which R^T R may miss the identity; the servo law asks the same of its mount.
constexpr double kRotationTolerance = 1e-6;

void require(bool good, const std::string& message) {
  if (!good) throw std::invalid_argument(message);
}

void require_length(const char* key, double value_m) {
  std::ostringstream message;
  message << key << ": must be positive and finite (m), is " << value_m;
  require(std::isfinite(value_m) && value_m > 0, message.str());
}

template <class To, class From>
void require_rigid(const std::string& key, const Transform<To, From>& transform) {
  require(transform.translation.allFinite(), key + ": the translation must be finite (m)");
  require(rotation_defect(transform.rotation) <= kRotationTolerance,
          key +
              ": the rotation is no rotation matrix; its columns must be orthogonal, of length 1 "
              "and right-handed");
}

/// The check of one group of options, its name before the option's.
template <class Options>
void check_group(const std::string& group, const Options& options) {
  try {
    options.check();
  } catch (const std::invalid_argument& e) {
    throw std::invalid_argument(group + '.' + e.what());
  }
}

void check_goal(const Task& task) {
  require_rigid("goal", task.goal);
  const std::vector<Feature> desired = desired_features(task);
  require(
      std::all_of(desired.begin(), desired.end(), [](const Feature& f) { return f.depth_m > 0; }),
      "goal: the target is not in front of the camera; its translation z must be positive");
  require(task.goal.rotation.col(2).dot(task.goal.translation) > 0,
          "goal: the camera would see the back of the target; the target's z axis must point away "
          "from the camera");
  const LawAnswer there = law_on_body(law_input(desired, task), task.body_from_camera, task.servo);
  require(there.twist.has_value(),
          std::string("goal: from there the corners determine no command (") + name(there.refusal) +
              "); come nearer, look less along the plane, or choose a smaller servo.freedom");
}

/// The pose that takes the corners nearest to these points of the camera, in the least squares of
/// their distances (Kabsch 1976; exact for the corners of a pose).
TargetPose pose_of_corners(const std::vector<Feature>& measured, const Task& task) {
  const std::array<Eigen::Vector3d, 4> corners = target_corners(task);  // their mean is zero
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Feature& f = measured[i];
    const Eigen::Vector3d p = f.depth_m * Eigen::Vector3d(f.at.x, f.at.y, 1);
    centre += p / double(corners.size());
    spread += p * corners[i].transpose();
  }
  return {nearest_rotation(spread), centre};
}

}  // namespace

void Task::check() const {
  require_length("target_width_m", target_width_m);
  require_length("target_height_m", target_height_m);
  require_rigid("body_from_camera", body_from_camera);
  check_group("track", track);
  require(std::isfinite(pose.corner_noise_px) && pose.corner_noise_px >= 0,
          "pose.corner_noise_px: must be finite and not negative (px)");
  check_group("servo", servo);
  check_group("limits", limits);
  check_group("loss", loss);
  check_group("timing", timing);
  check_goal(*this);
}

std::array<Eigen::Vector3d, 4> target_corners(const Task& task) {
  const double x = task.target_width_m / 2;
  const double y = task.target_height_m / 2;
  return {{{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}}};
}

std::vector<Feature> desired_features(const Task& task) {
  return features(task.goal, target_corners(task));
}

LawInput law_input(const std::vector<Feature>& measured, const Task& task) {
  LawInput input;
  input.measured = measured;
  input.desired = desired_features(task);
  if (measured.size() != input.desired.size()) return input;
  const TargetPose pose = pose_of_corners(measured, task);
  const auto goal_from_camera = task.goal * pose.inverse();
  const auto camera_from_goal = goal_from_camera.inverse();
  const Eigen::Vector3d n_in_goal = task.goal.rotation.col(2);
  const double distance_m = n_in_goal.dot(task.goal.translation);  // > 0: seen from the front
  input.camera_from_target = pose;
  input.goal_from_target = task.goal;
  input.goal_from_camera = Displacement{goal_from_camera.rotation, goal_from_camera.translation};
  input.camera_from_goal_homography =
      camera_from_goal.rotation + camera_from_goal.translation * n_in_goal.transpose() / distance_m;
  return input;
}

}  // namespace kestrel
