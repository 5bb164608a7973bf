#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "kestrel/geometry/transform.hpp"
#include "kestrel/servo/feature.hpp"

namespace kestrel {

/// Pose of the camera in the camera at its goal, c*Mc (m).
using GoalFromCamera = Transform<frame::Camera, frame::Camera>;

/// Where a free-flying camera starts, where it shall go and what it looks at.
struct Scenario {
  std::string name;  // "S0_tutorial"
  std::vector<Eigen::Vector3d>
      points_m;        // in Target; in order around the outline when they have one
  TargetPose goal{};   // camera_from_target to reach, c*Mo
  TargetPose start{};  // camera_from_target at step 0, cMo

  GoalFromCamera start_in_goal() const { return goal * start.inverse(); }

  /// Throws std::invalid_argument that names what is wrong: no point, a number that is not finite,
  /// a rotation that is none. What a law may refuse (too few points, points in line or behind the
  /// camera) is no mistake: the run's end names it.
  void check() const;
};

/// A scenario whose start is given by the camera's pose in the goal camera.
Scenario scenario_from(const std::string& name, const std::vector<Eigen::Vector3d>& points_m,
                       const TargetPose& goal, const GoalFromCamera& start_in_goal);

/// The camera that turns pixels of noise, of calibration and of the image's border into numbers of
/// the normalised plane. Image point x is seen at u = focal x + principal_u; the image holds
/// 0 <= u <= width and 0 <= v <= height.
struct LabCamera {
  double focal_px = 600;
  double principal_u_px = 320;
  double principal_v_px = 240;
  int width_px = 640;
  int height_px = 480;

  Pixel to_pixel(const ImagePoint& point) const {
    return {focal_px * point.x + principal_u_px, focal_px * point.y + principal_v_px};
  }

  /// Throws std::invalid_argument that names the first number out of range.
  void check() const;
};

/// The corners of a square about the Target's origin, in the order of the benchmark: (-,-), (+,-),
/// (+,+), (-,+), z = 0.
std::vector<Eigen::Vector3d> square_points(double side_m);

/// The features of points (m, Target) from this pose; depths may be negative, see features().
std::vector<Feature> seen_points(const TargetPose& camera_from_target,
                                 const std::vector<Eigen::Vector3d>& points_m);

/// Centre of gravity of the points, in Target (m).
Eigen::Vector3d centre_of(const std::vector<Eigen::Vector3d>& points_m);

}  // namespace kestrel
