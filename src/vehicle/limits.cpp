#include "kestrel/vehicle/limits.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace kestrel {
namespace {

using Eigen::Vector4d;

/// The vector scaled by the largest factor of at most 1 that leaves no |component| above its limit.
/// The last clamp takes off the one rounding that the product may leave above it, so that scaling
/// again changes nothing.
Vector4d scaled_into(const Vector4d& v, const Vector4d& limit) {
  double scale = 1;
  for (int i = 0; i < 4; ++i) {
    if (std::abs(v[i]) > limit[i]) scale = std::min(scale, limit[i] / std::abs(v[i]));
  }
  if (scale == 1) return v;
  return (scale * v).cwiseMax(-limit).cwiseMin(limit);
}

void require_positive(const VelocityCommand& limit, const std::string& group,
                      const std::string& per) {
  const auto require = [&](double value, const char* component, const char* unit) {
    if (std::isfinite(value) && value > 0) return;
    std::ostringstream message;
    message << group << '.' << component << ": must be positive and finite (" << unit << per
            << "), is " << value;
    throw std::invalid_argument(message.str());
  };
  require(limit.forward_m_s, "forward_m_s", "m/s");
  require(limit.right_m_s, "right_m_s", "m/s");
  require(limit.down_m_s, "down_m_s", "m/s");
  require(limit.yaw_rate_rad_s, "yaw_rate_rad_s", "rad/s");
}

}  // namespace

void CommandLimits::check() const {
  require_positive(speed, "speed", "");
  require_positive(acceleration, "acceleration", " per s");
}

VelocityCommand saturated(const VelocityCommand& command, const VelocityCommand& limit) {
  if (!is_finite(command) || !is_finite(limit)) return VelocityCommand::hover();
  return VelocityCommand::from_vector(scaled_into(command.vector(), limit.vector()));
}

VelocityCommand slewed(const VelocityCommand& previous, const VelocityCommand& wanted,
                       const VelocityCommand& acceleration, double duration_s) {
  const bool finite = is_finite(previous) && is_finite(wanted) && is_finite(acceleration);
  if (!finite || !std::isfinite(duration_s)) return VelocityCommand::hover();
  if (duration_s <= 0) return previous;
  const Vector4d change = wanted.vector() - previous.vector();
  const Vector4d allowed = scaled_into(change, acceleration.vector() * duration_s);
  if (allowed == change) return wanted;  // to the bit, which previous + change need not be
  const auto command = VelocityCommand::from_vector(previous.vector() + allowed);
  return is_finite(command) ? command : VelocityCommand::hover();
}

VelocityCommand limited(const VelocityCommand& previous, const VelocityCommand& wanted,
                        const CommandLimits& limits, double duration_s) {
  if (!is_finite(wanted)) return VelocityCommand::hover();
  return slewed(previous, saturated(wanted, limits.speed), limits.acceleration, duration_s);
}

}  // namespace kestrel
