#include "kestrel/sim/flight_controller.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "kestrel/geometry/rotation.hpp"

namespace kestrel {
namespace {

double within(double value, double limit) { return std::clamp(value, -limit, limit); }

/// A value held to its limits, and the integral that led to it: taken on only where the value is
/// free, or the error leads back.
struct Loop {
  double output = 0;
  double integral = 0;
};

struct Gains {
  double p = 0;
  double i = 0;
};

struct Range {
  double low = 0;
  double high = 0;
};

Loop proportional_integral(double error, const Gains& gains, double integral, double feed_forward,
                           const Range& range, double period_s) {
  const double grown = integral + gains.i * error * period_s;
  const double wanted = feed_forward + gains.p * error + grown;
  const bool pushes_out = (wanted > range.high && error > 0) || (wanted < range.low && error < 0);
  return {std::clamp(wanted, range.low, range.high), pushes_out ? integral : grown};
}

/// Accelerations of the heading frame that lead to the command, within these limits: the reference
/// closes on it with the proportional gain as its rate, and the integral sees only what is left
/// against the reference, so that a step does not wind it up.
struct VelocityLoop {
  double acceleration_m_s2 = 0;
  double reference_m_s = 0;
  double integral_m_s2 = 0;
};

VelocityLoop velocity_loop(double command, double measured, double reference, double integral,
                           const Gains& gains, const Range& range, double period_s) {
  const double lead = std::clamp(gains.p * (command - reference), range.low, range.high);
  const double next = reference + lead * period_s;
  const Loop loop = proportional_integral(next - measured, gains, integral, lead, range, period_s);
  return {loop.output, next, loop.integral};
}

struct Tilt {
  double roll = 0;
  double pitch = 0;
};

}  // namespace

void FlightControllerOptions::check() const {
  const auto require = [](bool good, const char* what) {
    if (!good) throw std::invalid_argument(what);
  };
  const auto positive = [](double x) { return std::isfinite(x) && x > 0; };
  const auto not_negative = [](double x) { return std::isfinite(x) && x >= 0; };
  require(positive(velocity_p_per_s), "velocity_p_per_s: must be positive");
  require(not_negative(velocity_i_per_s2), "velocity_i_per_s2: must not be negative");
  require(positive(climb_p_per_s), "climb_p_per_s: must be positive");
  require(not_negative(climb_i_per_s2), "climb_i_per_s2: must not be negative");
  require(positive(attitude_p_per_s), "attitude_p_per_s: must be positive");
  require(not_negative(attitude_i_per_s2), "attitude_i_per_s2: must not be negative");
  require(not_negative(attitude_d), "attitude_d: must not be negative");
  require(not_negative(heading_p_per_s), "heading_p_per_s: must not be negative");
  require(positive(yaw_rate_p_per_s), "yaw_rate_p_per_s: must be positive");
  require(not_negative(yaw_rate_i_per_s2), "yaw_rate_i_per_s2: must not be negative");
  require(max_tilt_rad > 0 && max_tilt_rad < 1, "max_tilt_rad: must be within (0, 1)");
  require(max_cyclic_rad > 0 && max_cyclic_rad < 0.7, "max_cyclic_rad: must be within (0, 0.7)");
  require(min_load >= 0 && min_load < 1, "min_load: must be within [0, 1)");
  require(max_load > 1 && max_load < 5, "max_load: must be within (1, 5)");
  require(positive(max_tail_n), "max_tail_n: must be positive");
  require(positive(max_heading_lead_rad), "max_heading_lead_rad: must be positive");
}

FlightControllerState holding(const RotorcraftState& state, const RotorcraftOptions& vehicle) {
  const Eigen::Matrix3d R = state.world_from_body.toRotationMatrix();
  FlightControllerState held;
  held.heading_reference_rad = std::atan2(R(1, 0), R(0, 0));
  held.velocity_integral_m_s2.y() = vehicle.gravity_m_s2 * R(2, 1) / R(2, 2);  // tan(roll)
  return held;
}

FlightControl control(const VelocityCommand& wanted, const MeasuredMotion& motion,
                      const FlightControllerState& state, double period_s,
                      const FlightControllerOptions& o, const RotorcraftOptions& vehicle) {
  const VelocityCommand command = is_finite(wanted) ? wanted : VelocityCommand::hover();
  FlightControl out;
  out.next = state;
  const double g = vehicle.gravity_m_s2;
  const double c = std::cos(motion.attitude.yaw);
  const double s = std::sin(motion.attitude.yaw);
  const Eigen::Vector3d& v = motion.velocity_m_s;
  const Eigen::Vector3d measured(c * v.x() + s * v.y(), -s * v.x() + c * v.y(), v.z());
  const Eigen::Vector4d asked = command.vector();
  const auto accelerate = [&](int axis, const Gains& gains, const Range& range) {
    const VelocityLoop loop =
        velocity_loop(asked[axis], measured[axis], state.velocity_reference_m_s[axis],
                      state.velocity_integral_m_s2[axis], gains, range, period_s);
    out.next.velocity_reference_m_s[axis] = loop.reference_m_s;
    out.next.velocity_integral_m_s2[axis] = loop.integral_m_s2;
    return loop.acceleration_m_s2;
  };

  // Velocity: forward and right by tilting, down by thrust.
  const double most = g * std::tan(o.max_tilt_rad);
  const Gains level{o.velocity_p_per_s, o.velocity_i_per_s2};
  const double forward_m_s2 = accelerate(0, level, {-most, most});
  const double right_m_s2 = accelerate(1, level, {-most, most});
  const double down_m_s2 = accelerate(2, {o.climb_p_per_s, o.climb_i_per_s2},
                                      {(1 - o.max_load) * g, (1 - o.min_load) * g});
  const Tilt tilt{std::atan(right_m_s2 / g), -std::atan(forward_m_s2 / g)};
  const double upright =
      std::max(0.5, std::cos(motion.attitude.roll) * std::cos(motion.attitude.pitch));
  out.controls.thrust_n = std::min((g - down_m_s2) / upright, o.max_load * g) * vehicle.mass_kg;

  // Attitude: the rotor turns the fuselage at disc tilt over its time constant.
  const double tau = vehicle.flapping_time_constant_s;
  const auto cyclic = [&](int axis, double angle_error, double rate) {
    const Loop loop = proportional_integral(
        angle_error, {o.attitude_p_per_s, o.attitude_i_per_s2}, state.attitude_integral_rad_s[axis],
        -o.attitude_d * rate, {-o.max_cyclic_rad / tau, o.max_cyclic_rad / tau}, period_s);
    out.next.attitude_integral_rad_s[axis] = loop.integral;
    return tau * loop.output;
  };
  out.controls.right_rad = cyclic(0, tilt.roll - motion.attitude.roll, motion.rate_rad_s.x());
  out.controls.back_rad = cyclic(1, tilt.pitch - motion.attitude.pitch, motion.rate_rad_s.y());

  // Heading.
  const double ahead = wrap_angle(state.heading_reference_rad + command.yaw_rate_rad_s * period_s -
                                  motion.attitude.yaw);
  const double lead = within(ahead, o.max_heading_lead_rad);
  out.next.heading_reference_rad = wrap_angle(motion.attitude.yaw + lead);
  const double rate_error =
      command.yaw_rate_rad_s + o.heading_p_per_s * lead - motion.rate_rad_s.z();
  const double per_n = vehicle.tail_arm_m / vehicle.inertia_kg_m2.z();
  const double hold = main_rotor_torque_n_m(out.controls.thrust_n, vehicle) / vehicle.tail_arm_m;
  const Loop tail = proportional_integral(rate_error, {o.yaw_rate_p_per_s, o.yaw_rate_i_per_s2},
                                          state.yaw_integral_rad_s2, hold * per_n,
                                          {-o.max_tail_n * per_n, o.max_tail_n * per_n}, period_s);
  out.next.yaw_integral_rad_s2 = tail.integral;
  out.controls.tail_n = tail.output / per_n;
  return out;
}

}  // namespace kestrel
