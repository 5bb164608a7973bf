#include "kestrel/sim/vehicle.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "random.hpp"

namespace kestrel {
namespace {

const VehicleOptions& checked(const VehicleOptions& options) {
  check(options);
  return options;
}

/// Rates about the axes of Body of angles that change at these rates (Rz Ry Rx).
Eigen::Vector3d body_rate(const HelicopterState& s, double roll_rate, double pitch_rate) {
  const double yaw_rate = s.yaw_rate_rad_s;
  return {roll_rate - std::sin(s.pitch) * yaw_rate,
          std::cos(s.roll) * pitch_rate + std::sin(s.roll) * std::cos(s.pitch) * yaw_rate,
          -std::sin(s.roll) * pitch_rate + std::cos(s.roll) * std::cos(s.pitch) * yaw_rate};
}

}  // namespace

void RotorcraftSystem::check() const {
  body.check();
  controller.check();
  sensor.check();
  wind.check();
  if (!(period_s > 0 && period_s <= 0.02)) {
    throw std::invalid_argument("period_s: must be within (0, 0.02]");
  }
}

void check(const VehicleOptions& options) {
  std::visit([](const auto& each) { each.check(); }, options);
}

Attitude attitude(const Transform<frame::World, frame::Body>& pose) {
  const Eigen::Matrix3d& R = pose.rotation;
  return {std::atan2(R(2, 1), R(2, 2)), -std::asin(std::clamp(R(2, 0), -1.0, 1.0)),
          std::atan2(R(1, 0), R(0, 0))};
}

Vehicle::Vehicle(const VehicleOptions& options, const HelicopterState& start, std::uint64_t seed)
    : options_(checked(options)), plant_(start) {
  if (const auto* system = std::get_if<RotorcraftSystem>(&options_)) {
    rotorcraft_ = hovering(start.position_m, start.yaw, system->body);
    memory_ = holding(rotorcraft_, system->body);
    sensor_.emplace(system->sensor, sim_detail::derived_seed(seed, 1), system->period_s);
    wind_.emplace(system->wind, sim_detail::derived_seed(seed, 2), system->period_s);
    seen_ = sensor_->measure(rotorcraft_);
  }
  look();
  if (std::holds_alternative<HelicopterOptions>(options_)) {
    motion_.rate_rad_s = body_rate(plant_, 0, 0);
  }
}

void Vehicle::advance(const VelocityCommand& command, double duration_s) {
  const VelocityCommand obeyed = is_finite(command) ? command : VelocityCommand::hover();
  if (std::holds_alternative<HelicopterOptions>(options_)) {
    advance_plant(obeyed, duration_s);
  } else {
    advance_rotorcraft(obeyed, duration_s);
  }
}

void Vehicle::advance_plant(const VelocityCommand& command, double duration_s) {
  auto options = std::get<HelicopterOptions>(options_);
  const int substeps = options.substeps;
  options.substeps = 1;
  const double h = duration_s / substeps;
  HelicopterState before = plant_;
  for (int i = 0; i < substeps; ++i) {
    before = plant_;
    plant_ = advanced(before, command, h, options);
  }
  look();
  if (h > 0) {
    motion_.rate_rad_s =
        body_rate(plant_, (plant_.roll - before.roll) / h, (plant_.pitch - before.pitch) / h);
  }
}

void Vehicle::advance_rotorcraft(const VelocityCommand& command, double duration_s) {
  const auto& system = std::get<RotorcraftSystem>(options_);
  flown_s_ += duration_s;
  const auto until = std::int64_t(std::llround(flown_s_ / system.period_s));
  for (; periods_ < until; ++periods_) {
    const FlightControl now =
        control(command, seen_, memory_, system.period_s, system.controller, system.body);
    memory_ = now.next;
    rotorcraft_ = advanced(rotorcraft_, now.controls, wind_->next(), system.period_s, system.body);
    seen_ = sensor_->measure(rotorcraft_);
  }
  look();
}

void Vehicle::look() {
  if (std::holds_alternative<HelicopterOptions>(options_)) {
    motion_.world_from_body = pose(plant_);
    motion_.velocity_m_s = plant_.velocity_m_s;
    seen_.velocity_m_s = plant_.velocity_m_s;
    measured_ = attitude(plant_);
    return;
  }
  motion_.world_from_body = {rotorcraft_.world_from_body.toRotationMatrix(),
                             rotorcraft_.position_m};
  motion_.velocity_m_s = rotorcraft_.velocity_m_s;
  motion_.rate_rad_s = rotorcraft_.rate_rad_s;
  measured_ = seen_.attitude;
}

}  // namespace kestrel
