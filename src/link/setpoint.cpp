#include "kestrel/link/setpoint.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kestrel {
namespace {

bool fits_float(double value) {
  return std::abs(value) <= double(std::numeric_limits<float>::max());  // false for NaN
}

float as_float(double value) {
  const auto rounded = float(value);
  return std::abs(rounded) < std::numeric_limits<float>::min() ? 0.0F : rounded;
}

}  // namespace

std::uint32_t time_boot_ms(double stamp_s) {
  constexpr double kTurn = 4294967296.0;  // 2^32
  const double ms = std::fmod(std::round(stamp_s * 1000), kTurn);
  if (!std::isfinite(ms)) return 0;
  return std::uint32_t(ms < 0 ? ms + kTurn : ms);
}

bool is_sendable(const VelocityCommand& command) {
  return fits_float(command.forward_m_s) && fits_float(command.right_m_s) &&
         fits_float(command.down_m_s) && fits_float(command.yaw_rate_rad_s);
}

mavlink::SetPositionTarget velocity_setpoint(const VelocityCommand& command,
                                             std::uint32_t time_boot_ms,
                                             const Recipient& recipient) {
  const VelocityCommand sent = is_sendable(command) ? command : VelocityCommand::hover();
  mavlink::SetPositionTarget setpoint;
  setpoint.time_boot_ms = time_boot_ms;
  setpoint.vx_m_s = as_float(sent.forward_m_s);
  setpoint.vy_m_s = as_float(sent.right_m_s);
  setpoint.vz_m_s = as_float(sent.down_m_s);
  setpoint.yaw_rate_rad_s = as_float(sent.yaw_rate_rad_s);
  setpoint.type_mask = kVelocityAndYawRate;
  setpoint.coordinate_frame = kHeadingFrame;
  setpoint.target_system = recipient.system_id;
  setpoint.target_component = recipient.component_id;
  return setpoint;
}

bool is_finite(const mavlink::SetPositionTarget& s) {
  const float values[] = {s.x_m,     s.y_m,     s.z_m,     s.vx_m_s,  s.vy_m_s,        s.vz_m_s,
                          s.ax_m_s2, s.ay_m_s2, s.az_m_s2, s.yaw_rad, s.yaw_rate_rad_s};
  return std::all_of(std::begin(values), std::end(values),
                     [](float v) { return std::isfinite(v); });
}

std::optional<VelocityCommand> velocity_of(const mavlink::SetPositionTarget& setpoint) {
  if (!is_finite(setpoint) || setpoint.type_mask != kVelocityAndYawRate ||
      setpoint.coordinate_frame != kHeadingFrame) {
    return std::nullopt;
  }
  return VelocityCommand{setpoint.vx_m_s, setpoint.vy_m_s, setpoint.vz_m_s,
                         setpoint.yaw_rate_rad_s};
}

}  // namespace kestrel
