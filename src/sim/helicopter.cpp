#include "kestrel/sim/helicopter.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace kestrel {
namespace {

/// Tilt (rad) whose acceleration closes this velocity error with time constant tau_v.
double tilt_for(double velocity_error_m_s, const HelicopterOptions& o) {
  const double tilt = std::atan(velocity_error_m_s / (o.tau_v_s * o.gravity_m_s2));
  return std::clamp(tilt, -o.max_tilt_rad, o.max_tilt_rad);
}

HelicopterState substep(HelicopterState s, const VelocityCommand& command, double h,
                        const HelicopterOptions& o) {
  const double c = std::cos(s.yaw);
  const double n = std::sin(s.yaw);
  const double forward = c * s.velocity_m_s.x() + n * s.velocity_m_s.y();
  const double right = -n * s.velocity_m_s.x() + c * s.velocity_m_s.y();
  s.pitch += h * (-tilt_for(command.forward_m_s - forward, o) - s.pitch) / o.tau_a_s;
  s.roll += h * (tilt_for(command.right_m_s - right, o) - s.roll) / o.tau_a_s;
  const double a_forward = -o.gravity_m_s2 * std::tan(s.pitch);
  const double a_right = o.gravity_m_s2 * std::tan(s.roll);
  s.velocity_m_s.x() += h * (c * a_forward - n * a_right);
  s.velocity_m_s.y() += h * (n * a_forward + c * a_right);
  s.velocity_m_s.z() += h * (command.down_m_s - s.velocity_m_s.z()) / o.tau_z_s;
  s.yaw_rate_rad_s += h * (command.yaw_rate_rad_s - s.yaw_rate_rad_s) / o.tau_r_s;
  s.position_m += h * s.velocity_m_s;
  s.yaw += h * s.yaw_rate_rad_s;
  return s;
}

}  // namespace

void HelicopterOptions::check() const {
  const auto require = [](bool good, const char* what) {
    if (!good) throw std::invalid_argument(what);
  };
  const auto positive = [](double x) { return std::isfinite(x) && x > 0; };
  require(positive(tau_v_s), "tau_v_s: must be positive");
  require(positive(tau_a_s), "tau_a_s: must be positive");
  require(positive(tau_z_s), "tau_z_s: must be positive");
  require(positive(tau_r_s), "tau_r_s: must be positive");
  require(max_tilt_rad > 0 && max_tilt_rad < M_PI / 2, "max_tilt_rad: must be within (0, pi/2)");
  require(positive(gravity_m_s2), "gravity_m_s2: must be positive");
  require(substeps > 0, "substeps: must be at least 1");
}

HelicopterState advanced(const HelicopterState& state, const VelocityCommand& command,
                         double duration_s, const HelicopterOptions& options) {
  if (!std::isfinite(duration_s) || duration_s < 0) {
    throw std::invalid_argument("duration_s: must be finite and not negative");
  }
  const bool finite = command.vector().allFinite();
  const VelocityCommand obeyed = finite ? command : VelocityCommand::hover();
  const double h = duration_s / options.substeps;
  HelicopterState next = state;
  for (int i = 0; i < options.substeps; ++i) next = substep(next, obeyed, h, options);
  return next;
}

Attitude attitude(const HelicopterState& state) {
  return {state.roll, state.pitch, wrap_angle(state.yaw)};
}

// Written out, not taken from geometry: the loop under test levels its features with geometry's
// rotations, and a mistake there must not cancel against the same mistake here.
Transform<frame::World, frame::Body> pose(const HelicopterState& state) {
  const double cr = std::cos(state.roll);
  const double sr = std::sin(state.roll);
  const double cp = std::cos(state.pitch);
  const double sp = std::sin(state.pitch);
  const double cy = std::cos(state.yaw);
  const double sy = std::sin(state.yaw);
  Eigen::Matrix3d R;
  R << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr,  //
      sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,   //
      -sp, cp * sr, cp * cr;
  return {R, state.position_m};
}

}  // namespace kestrel
