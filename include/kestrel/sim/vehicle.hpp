#pragma once

#include <cstdint>
#include <optional>
#include <variant>

#include <Eigen/Core>

#include "kestrel/geometry/attitude.hpp"
#include "kestrel/geometry/transform.hpp"
#include "kestrel/sim/flight_controller.hpp"
#include "kestrel/sim/helicopter.hpp"
#include "kestrel/sim/motion_sensor.hpp"
#include "kestrel/sim/rotorcraft.hpp"
#include "kestrel/sim/wind.hpp"
#include "kestrel/vehicle/velocity_command.hpp"

namespace kestrel {

/// The rigid-body helicopter with what is aboard and around it.
struct RotorcraftSystem {
  RotorcraftOptions body;
  FlightControllerOptions controller;
  MotionSensorOptions sensor;
  WindOptions wind;
  double period_s = 0.01;  // of the controller and of the integration, at most 0.02

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// What flies: the plant of first-order loops, or the rigid body.
using VehicleOptions = std::variant<HelicopterOptions, RotorcraftSystem>;

/// Throws std::invalid_argument that names the first option out of range.
void check(const VehicleOptions& options);

/// True motion at an instant.
struct TrueMotion {
  Transform<frame::World, frame::Body> world_from_body;
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();  // NED
  Eigen::Vector3d rate_rad_s = Eigen::Vector3d::Zero();    // in Body
};

/// Roll, pitch and yaw of a pose.
Attitude attitude(const Transform<frame::World, frame::Body>& pose);

/// A vehicle over time: velocity commands in, motion out. For one thread.
class Vehicle {
 public:
  /// At rest, hovering where `start` says with its yaw; the plant of first-order loops takes all of
  /// `start`. The seed is that of wind and sensors. Throws std::invalid_argument for options that
  /// do not check.
  Vehicle(const VehicleOptions& options, const HelicopterState& start, std::uint64_t seed);

  /// Flies duration_s with the command held; the rigid body by as many of its periods as are
  /// nearest to the time flown in all. A command that is not finite counts as hover.
  void advance(const VelocityCommand& command, double duration_s);

  const TrueMotion& motion() const { return motion_; }

  /// The attitude that the flight computer reports: with its errors, if it has any.
  Attitude measured_attitude() const { return measured_; }

  /// The velocity that it reports (NED), with its errors.
  Eigen::Vector3d measured_velocity_m_s() const { return seen_.velocity_m_s; }

 private:
  void advance_plant(const VelocityCommand& command, double duration_s);
  void advance_rotorcraft(const VelocityCommand& command, double duration_s);
  void look();

  VehicleOptions options_;
  HelicopterState plant_;
  RotorcraftState rotorcraft_;
  FlightControllerState memory_;
  std::optional<MotionSensor> sensor_;
  std::optional<Wind> wind_;
  double flown_s_ = 0;
  std::int64_t periods_ = 0;
  TrueMotion motion_;
  MeasuredMotion seen_;
  Attitude measured_;
};

}  // namespace kestrel
