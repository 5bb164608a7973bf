#include "kestrel/link/kinematic_vehicle.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "kestrel/geometry/rotation.hpp"

namespace kestrel {
namespace {

constexpr double kGravity_m_s2 = 9.81;

}  // namespace

void KinematicVehicleOptions::check() const {
  if (!(velocity_time_constant_s > 0 && std::isfinite(velocity_time_constant_s))) {
    throw std::invalid_argument("velocity_time_constant_s: must be finite and positive (s)");
  }
  if (!(yaw_time_constant_s > 0 && std::isfinite(yaw_time_constant_s))) {
    throw std::invalid_argument("yaw_time_constant_s: must be finite and positive (s)");
  }
}

KinematicVehicle::KinematicVehicle(const VehicleTruth& start,
                                   const KinematicVehicleOptions& options)
    : options_(options), truth_(start) {
  options_.check();
}

void KinematicVehicle::move(const MotionReference& reference, double step_s) {
  if (!(step_s > 0)) return;
  // v' = (u - v) / tau: v(t) = u + (v0 - u) exp(-t / tau), and its integral.
  const double tau = options_.velocity_time_constant_s;
  const double left = std::exp(-step_s / tau);
  const Eigen::Vector3d u = reference.velocity_ned_m_s;
  const Eigen::Vector3d behind = truth_.velocity_ned_m_s - u;
  truth_.position_ned_m += u * step_s + behind * tau * (1 - left);
  truth_.velocity_ned_m_s = u + behind * left;
  const double yaw_left = std::exp(-step_s / options_.yaw_time_constant_s);
  const double rate_behind = truth_.body_rates_rad_s.z() - reference.yaw_rate_rad_s;
  truth_.attitude.yaw = wrap_angle(truth_.attitude.yaw + reference.yaw_rate_rad_s * step_s +
                                   rate_behind * options_.yaw_time_constant_s * (1 - yaw_left));
  truth_.body_rates_rad_s.z() = reference.yaw_rate_rad_s + rate_behind * yaw_left;
  if (truth_.position_ned_m.z() > 0) {
    truth_.position_ned_m.z() = 0;
    truth_.velocity_ned_m_s.setZero();
  }
  // A rotor pushes along its own axis: it leans into its acceleration.
  const Eigen::Vector3d a = (u - truth_.velocity_ned_m_s) / tau;
  const double cos_yaw = std::cos(truth_.attitude.yaw);
  const double sin_yaw = std::sin(truth_.attitude.yaw);
  truth_.attitude.pitch = std::atan2(-(cos_yaw * a.x() + sin_yaw * a.y()), kGravity_m_s2);
  truth_.attitude.roll = std::atan2(-sin_yaw * a.x() + cos_yaw * a.y(), kGravity_m_s2);
}

}  // namespace kestrel
