#pragma once

#include <array>
#include <vector>

#include "kestrel/geometry/camera.hpp"
#include "kestrel/geometry/plane_pose.hpp"
#include "kestrel/geometry/transform.hpp"
#include "kestrel/loop/timing.hpp"
#include "kestrel/servo/servo.hpp"
#include "kestrel/vehicle/failsafe.hpp"
#include "kestrel/vehicle/limits.hpp"
#include "kestrel/vision/track_options.hpp"

namespace kestrel {

/// Everything the chain needs to know but the frames and the template's picture: one experiment.
struct Task {
  Camera camera;
  Mount body_from_camera{};
  double target_width_m = 0;
  double target_height_m = 0;
  TargetPose goal{};  // camera_from_target to reach, the camera levelled
  TrackOptions track{};
  PlanePoseOptions pose{};
  ServoOptions servo{};
  CommandLimits limits{};
  LossOptions loss{};
  TimingOptions timing{};

  /// Throws std::invalid_argument that names what is out of range (`key: what is wrong; remedy`):
  /// sizes and options, a mount or goal that is no rotation, a goal with the target behind the
  /// camera or seen from its back, a goal from which the law has no answer.
  void check() const;
};

/// The target's corners in the Target frame, m: top left, top right, bottom right, bottom left; the
/// outer edges of the template's pixels.
std::array<Eigen::Vector3d, 4> target_corners(const Task& task);

/// What the levelled camera is to see of those corners.
std::vector<Feature> desired_features(const Task& task);

/// All that a law may be told of a view: measured are the corners in the levelled camera, in the
/// order of desired_features. Their points in space give the pose, and the pose the displacement
/// to the goal and the homography of the target's plane. Without motion of the camera and time.
LawInput law_input(const std::vector<Feature>& measured, const Task& task);

}  // namespace kestrel
