#include "kestrel/sim/rotorcraft.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include <boost/numeric/odeint/algebra/array_algebra.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>

namespace kestrel {
namespace {

// Places in the vector that is integrated.
constexpr int kPosition = 0, kVelocity = 3, kQuaternion = 6, kRate = 10, kThrust = 13, kBack = 14,
              kRight = 15, kTail = 16, kSize = 17;
using StateVector = std::array<double, kSize>;
using Stepper = boost::numeric::odeint::runge_kutta4<StateVector, double, StateVector, double,
                                                     boost::numeric::odeint::array_algebra>;

Eigen::Map<const Eigen::Vector3d> vector_at(const StateVector& x, int at) {
  return Eigen::Map<const Eigen::Vector3d>(x.data() + at);
}
Eigen::Map<Eigen::Vector3d> vector_at(StateVector& x, int at) {
  return Eigen::Map<Eigen::Vector3d>(x.data() + at);
}

StateVector packed(const RotorcraftState& s) {
  StateVector x;
  vector_at(x, kPosition) = s.position_m;
  vector_at(x, kVelocity) = s.velocity_m_s;
  x[kQuaternion] = s.world_from_body.w();
  vector_at(x, kQuaternion + 1) = s.world_from_body.vec();
  vector_at(x, kRate) = s.rate_rad_s;
  x[kThrust] = s.thrust_n;
  x[kBack] = s.flap_back_rad;
  x[kRight] = s.flap_right_rad;
  x[kTail] = s.tail_n;
  return x;
}

RotorcraftState unpacked(const StateVector& x) {
  RotorcraftState s;
  s.position_m = vector_at(x, kPosition);
  s.velocity_m_s = vector_at(x, kVelocity);
  s.world_from_body =
      Eigen::Quaterniond(x[kQuaternion], x[kQuaternion + 1], x[kQuaternion + 2], x[kQuaternion + 3])
          .normalized();
  s.rate_rad_s = vector_at(x, kRate);
  s.thrust_n = x[kThrust];
  s.flap_back_rad = x[kBack];
  s.flap_right_rad = x[kRight];
  s.tail_n = x[kTail];
  return s;
}

/// Forces (N, Body) but gravity.
Eigen::Vector3d force(const StateVector& x, const Eigen::Vector3d& air_speed,
                      const RotorcraftOptions& o) {
  const double back = std::sin(x[kBack]);
  const double right = std::sin(x[kRight]);
  const Eigen::Vector3d rotor =
      x[kThrust] * Eigen::Vector3d(-back, right, -std::sqrt(1 - back * back - right * right));
  const Eigen::Vector3d damping = -o.mass_kg * o.damping_per_s.cwiseProduct(air_speed);
  const Eigen::Vector3d drag =
      -0.5 * o.air_density_kg_m3 *
      o.drag_area_m2.cwiseProduct(air_speed.cwiseAbs()).cwiseProduct(air_speed);
  return rotor + damping + drag - Eigen::Vector3d(0, x[kTail], 0);
}

/// Moments (N m, Body).
Eigen::Vector3d moment(const StateVector& x, const RotorcraftOptions& o) {
  const double stiffness = o.hub_stiffness_n_m + o.hub_above_m * x[kThrust];
  const double yaw = o.tail_arm_m * x[kTail] - main_rotor_torque_n_m(x[kThrust], o) -
                     o.yaw_damping_per_s * o.inertia_kg_m2.z() * x[kRate + 2];
  return {stiffness * x[kRight], stiffness * x[kBack], yaw};
}

/// The right-hand side.
struct Motion {
  const RotorcraftControls& controls;
  const Eigen::Vector3d& wind_m_s;
  const RotorcraftOptions& o;

  void operator()(const StateVector& x, StateVector& dx, double /*time_s*/) const {
    const Eigen::Quaterniond q(x[kQuaternion], x[kQuaternion + 1], x[kQuaternion + 2],
                               x[kQuaternion + 3]);
    const Eigen::Matrix3d R = q.toRotationMatrix();
    const Eigen::Vector3d rate = vector_at(x, kRate);
    const Eigen::Vector3d air_speed = R.transpose() * (vector_at(x, kVelocity) - wind_m_s);
    vector_at(dx, kPosition) = vector_at(x, kVelocity);
    vector_at(dx, kVelocity) =
        R * force(x, air_speed, o) / o.mass_kg + Eigen::Vector3d(0, 0, o.gravity_m_s2);
    dx[kQuaternion] = -0.5 * q.vec().dot(rate);
    vector_at(dx, kQuaternion + 1) = 0.5 * (q.w() * rate + q.vec().cross(rate));
    const Eigen::Vector3d spin = o.inertia_kg_m2.cwiseProduct(rate);
    vector_at(dx, kRate) = (moment(x, o) - rate.cross(spin)).cwiseQuotient(o.inertia_kg_m2);
    dx[kThrust] = (controls.thrust_n - x[kThrust]) / o.thrust_time_constant_s;
    dx[kBack] = (controls.back_rad - x[kBack]) / o.flapping_time_constant_s - rate.y();
    dx[kRight] = (controls.right_rad - x[kRight]) / o.flapping_time_constant_s - rate.x();
    dx[kTail] = (controls.tail_n - x[kTail]) / o.tail_time_constant_s;
  }
};

}  // namespace

void RotorcraftOptions::check() const {
  const auto positive = [](double x, const char* name) {
    if (!std::isfinite(x) || x <= 0) {
      throw std::invalid_argument(std::string(name) + ": must be positive");
    }
  };
  const auto not_negative = [](const Eigen::Vector3d& x, const char* name) {
    if (!x.allFinite() || x.minCoeff() < 0) {
      throw std::invalid_argument(std::string(name) + ": must not be negative");
    }
  };
  positive(mass_kg, "mass_kg");
  positive(inertia_kg_m2.minCoeff(), "inertia_kg_m2");
  positive(gravity_m_s2, "gravity_m_s2");
  positive(air_density_kg_m3, "air_density_kg_m3");
  positive(rotor_radius_m, "rotor_radius_m");
  positive(rotor_speed_rad_s, "rotor_speed_rad_s");
  positive(figure_of_merit, "figure_of_merit");
  positive(flapping_time_constant_s, "flapping_time_constant_s");
  positive(thrust_time_constant_s, "thrust_time_constant_s");
  positive(tail_time_constant_s, "tail_time_constant_s");
  positive(tail_arm_m, "tail_arm_m");
  not_negative({hub_above_m, hub_stiffness_n_m, yaw_damping_per_s},
               "hub_above_m, hub_stiffness_n_m, yaw_damping_per_s");
  not_negative(damping_per_s, "damping_per_s");
  not_negative(drag_area_m2, "drag_area_m2");
}

double main_rotor_torque_n_m(double thrust_n, const RotorcraftOptions& o) {
  if (!(thrust_n > 0)) return 0;
  const double disc_m2 = M_PI * o.rotor_radius_m * o.rotor_radius_m;
  const double inflow_m_s = std::sqrt(thrust_n / (2 * o.air_density_kg_m3 * disc_m2));
  return thrust_n * inflow_m_s / (o.figure_of_merit * o.rotor_speed_rad_s);
}

RotorcraftState hovering(const Eigen::Vector3d& position_m, double heading,
                         const RotorcraftOptions& o) {
  const double weight_n = o.mass_kg * o.gravity_m_s2;
  RotorcraftState s;
  s.position_m = position_m;
  s.thrust_n = weight_n;
  // The tail pushes to the left, so the weight must pull to the right: W sin(roll) = tail. What
  // then bears the weight is W cos(roll), and the torque follows: the fixed point of a contraction.
  double roll = 0;
  for (int i = 0; i < 20; ++i) {
    s.thrust_n = weight_n * std::cos(roll);
    s.tail_n = main_rotor_torque_n_m(s.thrust_n, o) / o.tail_arm_m;
    roll = std::asin(s.tail_n / weight_n);
  }
  s.world_from_body = Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()) *
                      Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX());
  return s;
}

RotorcraftControls trim(const RotorcraftState& s) {
  return {s.thrust_n, s.flap_back_rad, s.flap_right_rad, s.tail_n};
}

RotorcraftState advanced(const RotorcraftState& state, const RotorcraftControls& controls,
                         const Eigen::Vector3d& wind_m_s, double duration_s,
                         const RotorcraftOptions& options) {
  StateVector x = packed(state);
  Stepper().do_step(Motion{controls, wind_m_s, options}, x, 0.0, duration_s);
  return unpacked(x);
}

}  // namespace kestrel
