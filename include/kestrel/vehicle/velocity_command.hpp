#pragma once

#include <Eigen/Core>

#include "kestrel/geometry/twist.hpp"

namespace kestrel {

/// What the flight controller is asked for: velocities in the heading frame (Body levelled, same
/// yaw) and the yaw rate, positive clockwise seen from above.
struct VelocityCommand {
  double forward_m_s = 0;
  double right_m_s = 0;
  double down_m_s = 0;
  double yaw_rate_rad_s = 0;

  /// Exact zeros.
  static VelocityCommand hover() { return {}; }

  Eigen::Vector4d vector() const { return {forward_m_s, right_m_s, down_m_s, yaw_rate_rad_s}; }
  static VelocityCommand from_vector(const Eigen::Vector4d& v) { return {v[0], v[1], v[2], v[3]}; }
};

/// True when no number is NaN or infinite.
bool is_finite(const VelocityCommand& command);

/// The four velocities of a body twist that a helicopter can be asked for; hover when the twist is
/// not finite.
VelocityCommand to_command(const BodyTwist& twist);

/// Where commands go: a socket, the simulator.
class CommandSink {
 public:
  virtual ~CommandSink() = default;

  /// Sends the command decided for the frame captured at stamp_s. Never throws: a sink that cannot
  /// send counts a failure.
  virtual void send(const VelocityCommand& command, double stamp_s) noexcept = 0;

  /// Commands that could not be sent.
  virtual long failures() const = 0;
};

}  // namespace kestrel
