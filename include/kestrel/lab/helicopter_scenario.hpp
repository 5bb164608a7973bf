#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "kestrel/geometry/transform.hpp"

namespace kestrel {

/// The camera that looks ahead: c_x = b_y, c_y = b_z, c_z = b_x, at this place of the body (m).
Mount forward_camera(const Eigen::Vector3d& place_m = Eigen::Vector3d::Zero());

/// The camera that looks down: c_x = b_y, c_y = -b_x, c_z = b_z, at this place of the body (m).
Mount down_camera(const Eigen::Vector3d& place_m = Eigen::Vector3d::Zero());

/// A target on an upright wall that looks south: its x is east, its y down, its z north; its centre
/// is the world's origin.
Transform<frame::World, frame::Target> wall();

/// Where a helicopter starts, where it shall go and what it looks at.
struct HelicopterScenario {
  std::string name;                                                   // "H0"
  std::vector<Eigen::Vector3d> points_m;                              // in Target
  Transform<frame::World, frame::Target> world_from_target = wall();  // at time 0
  Eigen::Vector3d target_velocity_m_s = Eigen::Vector3d::Zero();      // NED
  Mount body_from_camera = forward_camera();
  TargetPose goal{};                                         // c*Mo, of the camera levelled
  Eigen::Vector3d start_camera_m = Eigen::Vector3d::Zero();  // NED, of the camera, at rest, level
  double start_yaw_rad = 0;

  /// Throws std::invalid_argument: fewer than three points, something not finite, no rotation, a
  /// goal in which the helicopter is not level (1e-6 rad), a point behind the camera at the goal.
  void check() const;
};

/// The heading psi* (rad) of the helicopter at the goal.
double goal_heading(const HelicopterScenario& scenario);

/// H0: from (-9, 1.5, 1) m, level, at rest, heading north, to 5 m in front of a square of 1 m.
HelicopterScenario helicopter_h0();

/// H1: the same with a heading of -12 deg.
HelicopterScenario helicopter_h1();

/// Of the benchmark, in order: H0, H1.
const std::vector<HelicopterScenario>& helicopter_scenarios();

}  // namespace kestrel
