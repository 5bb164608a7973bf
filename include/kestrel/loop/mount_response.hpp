#pragma once

#include <string>
#include <vector>

#include "kestrel/loop/task.hpp"
#include "kestrel/vehicle/velocity_command.hpp"

namespace kestrel {

/// How the target's image may differ from the one that is wanted.
enum class ImageChange {
  Right,      // it lies to the right
  Lower,      // it lies lower
  Larger,     // it is larger: too near
  Clockwise,  // it is turned clockwise about the view
};

/// What a task does about a small change of the image, seen from its goal.
struct MountResponse {
  ImageChange change = ImageChange::Right;
  VelocityCommand command;  // of the law, before the limits; hover when it has no answer
  LawRefusal refusal = LawRefusal::None;
  double distance_m = 0;  // of the goal: weighs a yaw rate against a velocity
  /// The length of the command (its yaw rate times the distance) over that of the motion that the
  /// target made times the gain: about 1 where the vehicle can undo the change, 0 where it cannot.
  double effort = 0;
};

/// The answers of the task's law, mount and freedoms to each ImageChange, in the order of the
/// enumeration. The target is moved by a hundredth of its distance (turned by a hundredth of a
/// radian) from the goal, in the levelled camera; gain as at the goal, no smooth start.
std::vector<MountResponse> mount_responses(const Task& task);

/// A task of the default law with this mount and a target of 1 m, squarely 5 m ahead: for a mount
/// of which nothing else is known.
Task task_with_mount(const Mount& body_from_camera);

/// "target to the right in the image -> the vehicle moves right". Names the velocities that are at
/// least a quarter of the largest, yaw rates at the target's distance; says so when there is none.
std::string describe(const MountResponse& response);

}  // namespace kestrel
