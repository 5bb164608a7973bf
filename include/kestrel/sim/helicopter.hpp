#pragma once

#include <Eigen/Core>

#include "kestrel/geometry/attitude.hpp"
#include "kestrel/geometry/transform.hpp"
#include "kestrel/vehicle/velocity_command.hpp"

namespace kestrel {

/// A helicopter with its flight controller, seen from outside: velocity references in, motion out.
struct HelicopterOptions {
  double tau_v_s = 0.5;                      // horizontal velocity loop
  double tau_a_s = 0.15;                     // roll and pitch
  double tau_z_s = 0.4;                      // vertical velocity
  double tau_r_s = 0.3;                      // yaw rate
  double max_tilt_rad = 0.3490658503988659;  // 20 deg, roll and pitch references each
  double gravity_m_s2 = 9.81;
  int substeps = 10;  // Euler steps per call of advanced

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// Motion of the helicopter at one instant. Angles as in Attitude, yaw not wrapped.
struct HelicopterState {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();    // of Body in World (NED)
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();  // NED
  double roll = 0;
  double pitch = 0;
  double yaw = 0;
  double yaw_rate_rad_s = 0;
};

/// The state duration_s later with the command held: Euler substeps of a velocity loop that asks
/// for tilt, a first-order tilt that accelerates, first-order vertical speed and yaw rate. Each
/// substep uses what the substep has already updated, in the order tilt, velocity, yaw rate,
/// position, yaw. A command that is not finite counts as hover. Throws std::invalid_argument for a
/// duration that is negative or not finite.
HelicopterState advanced(const HelicopterState& state, const VelocityCommand& command,
                         double duration_s, const HelicopterOptions& options = {});

/// Roll, pitch and yaw, yaw wrapped into (-pi, pi].
Attitude attitude(const HelicopterState& state);

/// world_from_body, Rz(yaw) Ry(pitch) Rx(roll).
Transform<frame::World, frame::Body> pose(const HelicopterState& state);

}  // namespace kestrel
