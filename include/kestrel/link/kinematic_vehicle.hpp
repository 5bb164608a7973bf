#pragma once

#include <Eigen/Core>

#include "kestrel/geometry/attitude.hpp"

namespace kestrel {

/// Where a vehicle is and how it moves: north, east, down from where it started; rad, rad/s.
struct VehicleTruth {
  Eigen::Vector3d position_ned_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_ned_m_s = Eigen::Vector3d::Zero();
  Attitude attitude;
  Eigen::Vector3d body_rates_rad_s = Eigen::Vector3d::Zero();
};

/// What an autopilot wants of its vehicle.
struct MotionReference {
  Eigen::Vector3d velocity_ned_m_s = Eigen::Vector3d::Zero();
  double yaw_rate_rad_s = 0;
};

struct KinematicVehicleOptions {
  double velocity_time_constant_s = 0.4;
  double yaw_time_constant_s = 0.2;

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// A vehicle that follows the velocities wanted of it like a first-order lag, level but for the
/// tilt its acceleration takes; it does not sink into the ground at down 0.
class KinematicVehicle {
 public:
  /// Throws as KinematicVehicleOptions::check.
  explicit KinematicVehicle(const VehicleTruth& start = {},
                            const KinematicVehicleOptions& options = {});

  /// Follows the reference for step_s (the exact solution of the lag; nothing happens for a step
  /// that is not positive).
  void move(const MotionReference& reference, double step_s);

  const VehicleTruth& truth() const { return truth_; }

 private:
  KinematicVehicleOptions options_;
  VehicleTruth truth_;
};

}  // namespace kestrel
