#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "kestrel/sim/flight_controller.hpp"
#include "kestrel/sim/rotorcraft.hpp"

namespace kestrel {

/// Errors of the flight computer's estimate: a bias drawn once, and an error that wanders
/// (Gauss-Markov) with this standard deviation. Zero: the truth.
struct MotionSensorOptions {
  double attitude_bias_rad = 0;  // standard deviation of the bias of roll and pitch
  double heading_bias_rad = 0;
  double attitude_noise_rad = 0;
  double velocity_noise_m_s = 0;
  double rate_noise_rad_s = 0;    // white, of each step
  double correlation_time_s = 2;  // of attitude and velocity

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// Attitude, rates and velocity as a flight computer sees them. The same seed gives the same
/// errors.
class MotionSensor {
 public:
  /// Throws std::invalid_argument for options that do not check or a period that is not positive.
  MotionSensor(const MotionSensorOptions& options, std::uint64_t seed, double period_s);

  /// The measurement of the next period's end.
  MeasuredMotion measure(const RotorcraftState& truth);

 private:
  Eigen::Vector3d drawn(double deviation);

  MotionSensorOptions options_;
  std::uint64_t seed_;
  std::uint64_t draw_ = 0;
  double keep_;   // share of an error left after a period
  double fresh_;  // and the new part that keeps its variance
  Eigen::Vector3d attitude_bias_;
  Eigen::Vector3d attitude_error_;
  Eigen::Vector3d velocity_error_;
};

}  // namespace kestrel
