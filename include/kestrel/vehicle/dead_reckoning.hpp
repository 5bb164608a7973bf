#pragma once

#include <vector>

#include <Eigen/Core>

#include "kestrel/geometry/transform.hpp"
#include "kestrel/vehicle/velocity_command.hpp"

namespace kestrel {

/// How a vehicle follows its velocity command. Forward and right: a velocity loop over a tilt, v =
/// c / (velocity tilt s^2 + velocity s + 1); down and yaw rate: first-order lags. The defaults are
/// those of the benchmark's helicopter.
struct VelocityResponse {
  double velocity_s = 0.5;  // time constant of forward and right
  double tilt_s = 0.15;     // of roll and pitch behind them
  double vertical_s = 0.4;
  double yaw_s = 0.3;

  /// Throws std::invalid_argument that names the first one that is not positive and finite.
  void check() const;
};

/// A command and when the vehicle begins to obey it.
struct TimedCommand {
  double from_s = 0;
  VelocityCommand command;
};

/// What is known of a vehicle's motion at an instant from what it was told: nothing but a model
/// stands behind it, so that a measured velocity is better wherever there is one.
struct DeadReckoning {
  double stamp_s = 0;
  VelocityCommand velocity;                                     // heading frame
  Eigen::Vector2d acceleration_m_s2 = Eigen::Vector2d::Zero();  // forward, right
  std::vector<TimedCommand> told;  // oldest first; what was obeyed before the first is hover
};

/// The vehicle's place then in its place now, both levelled with their heading: coordinates in the
/// body as it was to coordinates in the body as it is.
using BodyMotion = Transform<frame::Body, frame::Body>;

/// The same vehicle, told this too. A command that begins before one told earlier takes its place.
DeadReckoning told(DeadReckoning motion, const TimedCommand& command);

/// The motion at a later instant; commands that are over are forgotten. As it is for an instant
/// that is not later. Steps of 10 ms: what they leave out is below 1 mm/s for commands of 2 m/s.
DeadReckoning advanced(DeadReckoning motion, double stamp_s, const VelocityResponse& response);

/// How the vehicle will have moved duration_s after the instant of `motion`.
BodyMotion travelled(const DeadReckoning& motion, double duration_s,
                     const VelocityResponse& response);

}  // namespace kestrel
