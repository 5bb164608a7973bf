#pragma once

#include <array>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace kestrel {

/// A single-rotor helicopter of the paper's class: an industrial twin with a 52 cc engine, flight
/// computer, camera and fuel aboard. No data sheet of that airframe gives inertia or rotor
/// constants; where a line says X-Cell, the figure is that of Gavrilets, Mettler & Feron ("Dynamic
/// model for a miniature aerobatic helicopter", 2003) scaled by mass and rotor radius squared;
/// where it says R-50, that of Mettler, Tischler & Kanade ("System identification of small-size
/// unmanned helicopter dynamics", 1999); the others are chosen.
struct RotorcraftOptions {
  double mass_kg = 12;                              // chosen
  Eigen::Vector3d inertia_kg_m2{0.35, 0.67, 0.55};  // X-Cell: 0.18, 0.34, 0.28 of 8.2 kg, 0.775 m
  double gravity_m_s2 = 9.81;
  double air_density_kg_m3 = 1.2;
  double rotor_radius_m = 0.90;
  double rotor_speed_rad_s = 150;          // tip speed 135 m/s, as of the X-Cell
  double figure_of_merit = 0.6;            // ideal power over real power in hover
  double hub_above_m = 0.25;               // the hub above the centre of gravity
  double hub_stiffness_n_m = 90;           // moment per flapping angle; X-Cell: 54
  double flapping_time_constant_s = 0.05;  // 0.046, without its stabiliser bar
  double thrust_time_constant_s = 0.10;    // servo and inflow
  double tail_time_constant_s = 0.06;
  double tail_arm_m = 1.1;
  Eigen::Vector3d damping_per_s{0.05, 0.15, 0.61};  // X_u, Y_v, Z_w
  double yaw_damping_per_s = 1.0;                   // of the tail rotor and fin
  Eigen::Vector3d drag_area_m2{0.15, 0.35, 0.25};   // of the fuselage

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// Motion and inner state. Body is FRD, world NED.
struct RotorcraftState {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
  Eigen::Quaterniond world_from_body = Eigen::Quaterniond::Identity();
  Eigen::Vector3d rate_rad_s = Eigen::Vector3d::Zero();  // in Body
  double thrust_n = 0;                                   // of the main rotor, along -z of Body
  double flap_back_rad = 0;   // tilt of its disc: positive raises the nose
  double flap_right_rad = 0;  // positive lowers the right side
  double tail_n = 0;          // of the tail rotor: positive turns right
};

/// What the controller asks of the rotors: where their states settle.
struct RotorcraftControls {
  double thrust_n = 0;
  double back_rad = 0;
  double right_rad = 0;
  double tail_n = 0;
};

/// Torque (N m) that turns the main rotor at this thrust, by momentum theory with the figure of
/// merit: T sqrt(T / (2 rho A)) / (FM Omega). It turns the fuselage left.
double main_rotor_torque_n_m(double thrust_n, const RotorcraftOptions& options);

/// The state in which the helicopter hovers in still air with this heading (rad): thrust bears the
/// weight, the tail rotor holds the torque, and a small roll holds the tail rotor's push.
RotorcraftState hovering(const Eigen::Vector3d& position_m, double heading,
                         const RotorcraftOptions& options);

/// The controls that keep a state's rotors as they are.
RotorcraftControls trim(const RotorcraftState& state);

/// The state duration_s later, with controls and wind (world, m/s) held: Newton and Euler's
/// equations of a rigid body under rotor forces, linear damping and quadratic drag against the air,
/// one Runge-Kutta step of fourth order (Boost.Odeint). Steps of more than about 20 ms are not
/// stable: the fuselage hangs in the rotor at 18 rad/s and the rotor follows in 50 ms.
RotorcraftState advanced(const RotorcraftState& state, const RotorcraftControls& controls,
                         const Eigen::Vector3d& wind_m_s, double duration_s,
                         const RotorcraftOptions& options);

}  // namespace kestrel
