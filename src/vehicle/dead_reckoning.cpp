#include "kestrel/vehicle/dead_reckoning.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <Eigen/Geometry>

namespace kestrel {
namespace {

constexpr double kStep_s = 0.01;

/// The command obeyed at an instant.
VelocityCommand obeyed(const DeadReckoning& motion, double at_s) {
  VelocityCommand command;
  for (const TimedCommand& each : motion.told) {
    if (each.from_s <= at_s) command = each.command;
  }
  return command;
}

/// The next instant at which another command begins, `until_s` when there is none before.
double next_change_s(const DeadReckoning& motion, double until_s) {
  for (const TimedCommand& each : motion.told) {
    if (each.from_s > motion.stamp_s) return std::min(each.from_s, until_s);
  }
  return until_s;
}

/// Each lag in its exact form over the step; the tilt is taken as it is half-way.
DeadReckoning after_step(DeadReckoning m, const VelocityCommand& command, double h,
                         const VelocityResponse& r) {
  Eigen::Vector4d v = m.velocity.vector();
  const Eigen::Vector4d c = command.vector();
  for (int i = 0; i < 2; ++i) {
    double& a = m.acceleration_m_s2[i];
    const double half = a + h / 2 * ((c[i] - v[i]) / r.velocity_s - a) / r.tilt_s;
    const double v_half = v[i] + h / 2 * a;
    v[i] += h * half;
    a += h * ((c[i] - v_half) / r.velocity_s - half) / r.tilt_s;
  }
  v[2] = c[2] + (v[2] - c[2]) * std::exp(-h / r.vertical_s);
  v[3] = c[3] + (v[3] - c[3]) * std::exp(-h / r.yaw_s);
  m.velocity = VelocityCommand::from_vector(v);
  m.stamp_s += h;
  return m;
}

/// Motion and place, in the heading frame of the start.
struct Way {
  DeadReckoning motion;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  double yaw_rad = 0;
};

Way flown(const DeadReckoning& start, double until_s, const VelocityResponse& response) {
  Way way{start};
  while (way.motion.stamp_s < until_s) {
    const double stretch_s = next_change_s(way.motion, until_s) - way.motion.stamp_s;
    const int steps = std::max(1, int(std::ceil(stretch_s / kStep_s)));
    const double end_s = way.motion.stamp_s + stretch_s;
    const VelocityCommand command = obeyed(way.motion, way.motion.stamp_s);
    for (int i = 0; i < steps; ++i) {
      const double h = stretch_s / steps;
      const Eigen::Vector4d before = way.motion.velocity.vector();
      way.motion = after_step(std::move(way.motion), command, h, response);
      const Eigen::Vector4d mean = (before + way.motion.velocity.vector()) / 2;
      const Eigen::AngleAxisd midway(way.yaw_rad + h / 2 * mean[3], Eigen::Vector3d::UnitZ());
      way.position_m += h * (midway * Eigen::Vector3d(mean.head<3>()));
      way.yaw_rad += h * mean[3];
    }
    way.motion.stamp_s = end_s;  // no rounding of the steps is carried on
  }
  return way;
}

}  // namespace

void VelocityResponse::check() const {
  const auto require = [](double value, const char* name) {
    if (!(std::isfinite(value) && value > 0)) {
      throw std::invalid_argument(std::string(name) + ": must be positive and finite (s)");
    }
  };
  require(velocity_s, "velocity_s");
  require(tilt_s, "tilt_s");
  require(vertical_s, "vertical_s");
  require(yaw_s, "yaw_s");
}

DeadReckoning told(DeadReckoning motion, const TimedCommand& command) {
  auto& told = motion.told;
  const auto later = [&](const TimedCommand& each) { return each.from_s >= command.from_s; };
  told.erase(std::find_if(told.begin(), told.end(), later), told.end());
  told.push_back(command);
  return motion;
}

DeadReckoning advanced(DeadReckoning motion, double stamp_s, const VelocityResponse& response) {
  motion = flown(motion, stamp_s, response).motion;
  auto& told = motion.told;
  while (told.size() > 1 && told[1].from_s <= motion.stamp_s) told.erase(told.begin());
  return motion;
}

BodyMotion travelled(const DeadReckoning& motion, double duration_s,
                     const VelocityResponse& response) {
  const Way way = flown(motion, motion.stamp_s + duration_s, response);
  const BodyMotion then_from_now{
      Eigen::AngleAxisd(way.yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix(), way.position_m};
  return then_from_now.inverse();
}

}  // namespace kestrel
