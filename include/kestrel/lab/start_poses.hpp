#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kestrel/lab/scenario.hpp"

namespace kestrel {

/// Where a run starts, in numbers that a file keeps exactly: the pose of the camera in the goal
/// camera, c*Mc.
struct StartPose {
  Eigen::Vector3d translation_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d rotation_vector_rad = Eigen::Vector3d::Zero();
};

/// The scenario begun from there, under its own name.
Scenario started_from(const Scenario& scenario, const StartPose& start);

/// Where starts are drawn from: c*Mc = (t, exp(tilt) Rz(roll)), t uniform in a box about the goal,
/// the tilt's axis uniform in the image plane, its angle and the roll uniform.
struct StartBox {
  Eigen::Vector3d half_size_m{0.5, 0.5, 0.5};    // along the goal camera's axes
  double largest_tilt_rad = 0.7853981633974483;  // 45 deg
  double largest_roll_rad = 3.141592653589793;
  double margin_px = 0;    // the target's points stand this far inside the image
  double nearest_m = 0.1;  // least depth of a point
  int tries = 100000;      // draws for one start before it is given up

  /// Throws std::invalid_argument that names the first one out of range.
  void check() const;
};

/// So many starts from the box, each with all points of the scenario in front of the camera and in
/// its image (others are drawn again). The same seed gives the same starts, and the first n of
/// more. Throws std::invalid_argument when a start is not found: the box and the image hardly meet.
std::vector<StartPose> start_poses(const Scenario& scenario, const LabCamera& camera,
                                   const StartBox& box, std::uint64_t seed, int count);

}  // namespace kestrel
