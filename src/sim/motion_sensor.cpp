#include "kestrel/sim/motion_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "kestrel/geometry/rotation.hpp"

#include "random.hpp"

namespace kestrel {
namespace {

const MotionSensorOptions& checked(const MotionSensorOptions& options, double period_s) {
  options.check();
  if (!std::isfinite(period_s) || period_s <= 0) {
    throw std::invalid_argument("period_s: must be positive");
  }
  return options;
}

Attitude true_attitude(const RotorcraftState& s) {
  const Eigen::Matrix3d R = s.world_from_body.toRotationMatrix();
  return {std::atan2(R(2, 1), R(2, 2)), -std::asin(std::clamp(R(2, 0), -1.0, 1.0)),
          std::atan2(R(1, 0), R(0, 0))};
}

}  // namespace

void MotionSensorOptions::check() const {
  const auto not_negative = [](double x, const char* name) {
    if (!std::isfinite(x) || x < 0) {
      throw std::invalid_argument(std::string(name) + ": must not be negative");
    }
  };
  not_negative(attitude_bias_rad, "attitude_bias_rad");
  not_negative(heading_bias_rad, "heading_bias_rad");
  not_negative(attitude_noise_rad, "attitude_noise_rad");
  not_negative(velocity_noise_m_s, "velocity_noise_m_s");
  not_negative(rate_noise_rad_s, "rate_noise_rad_s");
  if (!std::isfinite(correlation_time_s) || correlation_time_s <= 0) {
    throw std::invalid_argument("correlation_time_s: must be positive");
  }
}

MotionSensor::MotionSensor(const MotionSensorOptions& options, std::uint64_t seed, double period_s)
    : options_(checked(options, period_s)),
      seed_(seed),
      keep_(std::exp(-period_s / options.correlation_time_s)),
      fresh_(std::sqrt(1 - keep_ * keep_)) {
  const Eigen::Vector3d bias(options_.attitude_bias_rad, options_.attitude_bias_rad,
                             options_.heading_bias_rad);
  attitude_bias_ = bias.cwiseProduct(drawn(1));
  attitude_error_ = drawn(options_.attitude_noise_rad);
  velocity_error_ = drawn(options_.velocity_noise_m_s);
}

MeasuredMotion MotionSensor::measure(const RotorcraftState& truth) {
  attitude_error_ = keep_ * attitude_error_ + fresh_ * drawn(options_.attitude_noise_rad);
  velocity_error_ = keep_ * velocity_error_ + fresh_ * drawn(options_.velocity_noise_m_s);
  const Attitude attitude = true_attitude(truth);
  const Eigen::Vector3d error = attitude_bias_ + attitude_error_;
  MeasuredMotion seen;
  seen.attitude = {attitude.roll + error.x(), attitude.pitch + error.y(),
                   wrap_angle(attitude.yaw + error.z())};
  seen.rate_rad_s = truth.rate_rad_s + drawn(options_.rate_noise_rad_s);
  seen.velocity_m_s = truth.velocity_m_s + velocity_error_;
  return seen;
}

Eigen::Vector3d MotionSensor::drawn(double deviation) {
  if (deviation == 0) return Eigen::Vector3d::Zero();
  const auto a = sim_detail::normal_pair(seed_, draw_++);
  const auto b = sim_detail::normal_pair(seed_, draw_++);
  return deviation * Eigen::Vector3d(a.first, a.second, b.first);
}

}  // namespace kestrel
