#pragma once

#include <cmath>

#include <Eigen/Core>

#include "kestrel/geometry/attitude.hpp"
#include "kestrel/geometry/transform.hpp"
#include "kestrel/loop/task.hpp"
#include "kestrel/vehicle/velocity_command.hpp"

/// A body that does what it is told, flown by composing poses: no twist is mapped here, so that an
/// error in the map of the code under test has nothing to cancel against.
namespace kestrel::test {

inline Eigen::Matrix3d turn_z(double a) {
  return (Eigen::Matrix3d() << std::cos(a), -std::sin(a), 0, std::sin(a), std::cos(a), 0, 0, 0, 1)
      .finished();
}
inline Eigen::Matrix3d turn_y(double a) {
  return (Eigen::Matrix3d() << std::cos(a), 0, std::sin(a), 0, 1, 0, -std::sin(a), 0, std::cos(a))
      .finished();
}
inline Eigen::Matrix3d turn_x(double a) {
  return (Eigen::Matrix3d() << 1, 0, 0, 0, std::cos(a), -std::sin(a), 0, std::sin(a), std::cos(a))
      .finished();
}

using WorldFromBody = Transform<frame::World, frame::Body>;
using WorldFromCamera = Transform<frame::World, frame::Camera>;
using WorldFromTarget = Transform<frame::World, frame::Target>;

/// Where a helicopter is: NED, m; its heading and tilt, rad.
struct Flight {
  Eigen::Vector3d ned = Eigen::Vector3d::Zero();
  Attitude attitude;

  WorldFromBody body() const {
    return {turn_z(attitude.yaw) * turn_y(attitude.pitch) * turn_x(attitude.roll), ned};
  }
  WorldFromCamera camera(const Mount& mount) const { return body() * mount; }
  /// The camera at the same place, mounted on a body without tilt.
  WorldFromCamera level_camera(const Mount& mount) const {
    return {turn_z(attitude.yaw) * mount.rotation, camera(mount).translation};
  }
  /// After duration_s of exactly the commanded velocities, in the heading frame; in small steps.
  Flight after(const VelocityCommand& command, double duration_s) const {
    Flight f = *this;
    const int steps = 10;
    const double dt = duration_s / steps;
    for (int i = 0; i < steps; ++i) {
      const double midway = f.attitude.yaw + command.yaw_rate_rad_s * dt / 2;
      f.ned += dt * (turn_z(midway) * command.vector().head<3>());
      f.attitude.yaw += command.yaw_rate_rad_s * dt;
    }
    return f;
  }
};

/// Mounts used by the tests: looking forward and looking down (top towards the nose), off the
/// body's origin.
inline Mount forward_camera() {
  return {(Eigen::Matrix3d() << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished(), {0.3, -0.05, 0.1}};
}
inline Mount down_camera() {
  return {(Eigen::Matrix3d() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished(), {0.2, 0.1, 0.15}};
}

/// A target of 1 m x 0.8 m to be seen squarely from 3 m, by a camera of 320 x 240.
inline Task example_task(const Mount& mount) {
  CameraParameters parameters;
  parameters.px = parameters.py = 300;
  parameters.u0 = 159.5;
  parameters.v0 = 119.5;
  parameters.width = 320;
  parameters.height = 240;
  Task task{Camera(parameters)};
  task.body_from_camera = mount;
  task.target_width_m = 1;
  task.target_height_m = 0.8;
  task.goal.translation = {0, 0, 3};
  task.servo.gain_per_s = 1;
  return task;
}

/// The target, placed so that a level flight at NED (0, 0, 0) with heading 0 is at the goal.
inline WorldFromTarget target_for(const Task& task) {
  return Flight{}.camera(task.body_from_camera) * task.goal;
}

/// The target's corners as the camera sees them.
inline std::vector<Feature> seen_from(const WorldFromCamera& camera, const WorldFromTarget& target,
                                      const Task& task) {
  return features(camera.inverse() * target, target_corners(task));
}

}  // namespace kestrel::test
