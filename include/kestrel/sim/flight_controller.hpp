#pragma once

#include <Eigen/Core>

#include "kestrel/geometry/attitude.hpp"
#include "kestrel/sim/rotorcraft.hpp"
#include "kestrel/vehicle/velocity_command.hpp"

namespace kestrel {

/// What the flight computer believes of the motion.
struct MeasuredMotion {
  Attitude attitude;                                       // rad
  Eigen::Vector3d rate_rad_s = Eigen::Vector3d::Zero();    // in Body
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();  // NED
};

/// The low-level controller of the paper: PID loops for attitude, velocity and heading.
struct FlightControllerOptions {
  double velocity_p_per_s = 1.4;  // acceleration per velocity error, forward and right
  double velocity_i_per_s2 = 0.8;
  double climb_p_per_s = 2.5;  // the same, down
  double climb_i_per_s2 = 1.5;
  double attitude_p_per_s = 6.0;  // rate asked for per error of roll and pitch
  double attitude_i_per_s2 = 1.0;
  double attitude_d = 0.1;        // share of the rate that is taken off
  double heading_p_per_s = 2.0;   // rate asked for per error of heading
  double yaw_rate_p_per_s = 8.0;  // angular acceleration per error of the rate
  double yaw_rate_i_per_s2 = 4.0;
  double max_tilt_rad = 0.3490658503988659;  // 20 deg
  double max_cyclic_rad = 0.17;              // of each axis
  double min_load = 0.3, max_load = 1.7;     // thrust over weight
  double max_tail_n = 30;
  double max_heading_lead_rad = 0.5;  // how far the heading asked for may run ahead

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// What the controller remembers.
struct FlightControllerState {
  Eigen::Vector3d velocity_reference_m_s = Eigen::Vector3d::Zero();   // heading frame
  Eigen::Vector3d velocity_integral_m_s2 = Eigen::Vector3d::Zero();   // heading frame
  Eigen::Vector2d attitude_integral_rad_s = Eigen::Vector2d::Zero();  // roll, pitch
  double yaw_integral_rad_s2 = 0;
  double heading_reference_rad = 0;
};

/// The memory with which a helicopter that hovers goes on hovering: its heading, and the
/// acceleration that its roll stands for.
FlightControllerState holding(const RotorcraftState& state, const RotorcraftOptions& vehicle);

struct FlightControl {
  RotorcraftControls controls;
  FlightControllerState next;
};

/// One step of all loops: a reference that follows the command without a jump, velocity error
/// against it -> tilt and thrust, tilt error -> cyclic, heading error ->
/// yaw rate -> tail. The heading asked for moves with the commanded yaw rate. Integrators stop
/// where their output is limited. A command that is not finite counts as hover.
FlightControl control(const VelocityCommand& command, const MeasuredMotion& motion,
                      const FlightControllerState& state, double period_s,
                      const FlightControllerOptions& options, const RotorcraftOptions& vehicle);

}  // namespace kestrel
