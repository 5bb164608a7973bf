#pragma once

#include <array>
#include <optional>

#include <Eigen/Core>

#include "kestrel/geometry/attitude.hpp"
#include "kestrel/geometry/frames.hpp"
#include "kestrel/geometry/pixel.hpp"
#include "kestrel/geometry/transform.hpp"
#include "kestrel/loop/task.hpp"

namespace kestrel {

/// The level frame at a target: its origin the target's centre, z down; x forward, that is into a
/// target that stands, and toward the upper edge of the picture on one that lies (within 45 degrees
/// of level); y right. A vehicle that faces the target squarely has the yaw 0.
using LevelTarget = Transform<frame::World, frame::Target>;

/// How the target stands against the plumb line, by a goal of the levelled camera: the same for all
/// goals that differ in place and heading only.
LevelTarget level_from_target(const TargetPose& goal, const Mount& body_from_camera);

/// Where a level vehicle is in the level frame at the target.
struct VehiclePlace {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  // forward, right, down
  double yaw_rad = 0;                                    // clockwise seen from above
};

/// The place of the vehicle whose levelled camera sees the target so.
VehiclePlace vehicle_place(const TargetPose& camera_from_target, const Mount& body_from_camera,
                           const LevelTarget& level_from_target);

/// The inverse: what the levelled camera sees from there.
TargetPose seen_from(const VehiclePlace& place, const Mount& body_from_camera,
                     const LevelTarget& level_from_target);

/// True when all of the target is in the picture that the goal wants, and for a camera whose size
/// nobody knows.
bool has_whole_target_in_picture(const Task& task);

/// What a map of the flight shows, in the level frame at the target.
struct FlightScene {
  std::array<Eigen::Vector3d, 4> target_m;  // its corners, as target_corners()
  VehiclePlace goal;
  std::optional<VehiclePlace> vehicle;  // when the target is seen
  /// Where the corners of the picture look, of length 1: top left, top right, bottom right, bottom
  /// left; with the vehicle's place.
  std::array<Eigen::Vector3d, 4> sight{};
};

/// seen: camera_from_target, the camera levelled; attitude: as far as it is known, else level.
FlightScene flight_scene(const Task& task, const std::optional<TargetPose>& seen,
                         const std::optional<Attitude>& attitude);

/// Where the horizon crosses the picture's left and right edges, or above and below where it is
/// steeper than 45 degrees, px; lens left out. The points may lie outside of the picture. Empty
/// for a camera that looks straight down, and where it is more than 1e5 px away.
std::optional<std::array<Pixel, 2>> horizon(const Camera& camera, const Mount& body_from_camera,
                                            const Attitude& attitude);

}  // namespace kestrel
