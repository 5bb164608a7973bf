#include "flying_vehicle.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "kestrel/geometry/rotation.hpp"

#include "command_csv.hpp"

namespace kestrel::app {
namespace {

constexpr double kLoopsPeriod_s = 0.01;  // the rigid body has a period of its own
constexpr double kPast_s = 2;

double period_of(const VehicleOptions& vehicle) {
  const auto* rigid = std::get_if<RotorcraftSystem>(&vehicle);
  return rigid != nullptr ? rigid->period_s : kLoopsPeriod_s;
}

HelicopterState placed(HelicopterState start, const AutopilotModelOptions& rules, double ground_m) {
  if (!rules.starts_armed) start.position_m.z() = ground_m;
  return start;
}

}  // namespace

TrueMotion carried_on(const TrueMotion& motion, double ahead_s) {
  TrueMotion later = motion;
  later.world_from_body.translation += motion.velocity_m_s * ahead_s;
  later.world_from_body.rotation =
      motion.world_from_body.rotation * rotation_from_vector(motion.rate_rad_s * ahead_s);
  return later;
}

FlyingVehicle::FlyingVehicle(const FlyingVehicleOptions& options)
    : options_(options),
      model_(options.rules),
      vehicle_(options.vehicle, placed(options.start, options.rules, options.ground_down_m),
               options.seed),
      origin_m_(options.start.position_m.x(), options.start.position_m.y(), options.ground_down_m),
      period_s_(period_of(options.vehicle)),
      flown_s_(options.rules.boot_s) {
  meet_the_ground();
  keep();
}

VehicleTruth FlyingVehicle::told() const {
  const TrueMotion& motion = vehicle_.motion();
  VehicleTruth truth;
  truth.position_ned_m = motion.world_from_body.translation - origin_m_;
  truth.attitude = vehicle_.measured_attitude();
  if (stands_) {
    truth.position_ned_m.z() = 0;
    return truth;
  }
  truth.velocity_ned_m_s = motion.velocity_m_s;
  truth.body_rates_rad_s = motion.rate_rad_s;
  return truth;
}

/// What the autopilot wants, in the heading frame of this moment: its velocities were turned into
/// north and east when the setpoint came.
VelocityCommand FlyingVehicle::command() const {
  const MotionReference& wanted = model_.reference();
  const Eigen::Vector3d& v = wanted.velocity_ned_m_s;
  const double yaw = vehicle_.measured_attitude().yaw;
  return {std::cos(yaw) * v.x() + std::sin(yaw) * v.y(),
          -std::sin(yaw) * v.x() + std::cos(yaw) * v.y(), v.z(), wanted.yaw_rate_rad_s};
}

FlyingVehicle::Frames FlyingVehicle::receive(Bytes datagram, double now_s) {
  Frames told_before = fly_until(now_s);
  Frames answers = model_.receive(datagram, told(), now_s);
  std::move(answers.begin(), answers.end(), std::back_inserter(told_before));
  return told_before;
}

FlyingVehicle::Frames FlyingVehicle::fly_until(double now_s) {
  Frames due;
  while (flown_s_ + period_s_ <= now_s) {
    step();
    Frames more = model_.tick(told(), flown_s_);
    std::move(more.begin(), more.end(), std::back_inserter(due));
  }
  return due;
}

void FlyingVehicle::step() {
  const VelocityCommand wanted = command();
  if (stands_ && model_.armed() && wanted.down_m_s < 0) stands_ = false;
  if (!stands_) vehicle_.advance(wanted, period_s_);
  flown_s_ += period_s_;
  meet_the_ground();
  keep();
}

bool FlyingVehicle::is_grounded() const {
  const double height_m =
      options_.ground_down_m - vehicle_.motion().world_from_body.translation.z();
  return height_m <= 0 && !(model_.armed() && command().down_m_s < 0);
}

/// On its skids it is at rest, level, where it came down.
void FlyingVehicle::meet_the_ground() {
  if (stands_ || !is_grounded()) return;
  stands_ = true;
  const TrueMotion& motion = vehicle_.motion();
  hardest_touch_m_s_ = std::max(hardest_touch_m_s_, motion.velocity_m_s.norm());
  HelicopterState rest;
  rest.position_m = motion.world_from_body.translation;
  rest.position_m.z() = options_.ground_down_m;
  rest.yaw = attitude(motion.world_from_body).yaw;
  vehicle_ = Vehicle(options_.vehicle, rest, options_.seed);
}

void FlyingVehicle::keep() {
  Sample now{flown_s_, vehicle_.motion()};
  if (stands_) {
    now.motion.velocity_m_s.setZero();
    now.motion.rate_rad_s.setZero();
  }
  past_.push_back(now);
  while (past_.front().at_s < flown_s_ - kPast_s) past_.pop_front();
}

std::optional<TrueMotion> FlyingVehicle::motion_at(double time_s) const {
  const auto after =
      std::upper_bound(past_.begin(), past_.end(), time_s,
                       [](double time, const Sample& sample) { return time < sample.at_s; });
  if (after == past_.begin()) return std::nullopt;
  const Sample& before = *std::prev(after);
  return carried_on(before.motion, time_s - before.at_s);
}

void FlyingVehicle::report(Summary& summary) const {
  summary.begin_section("autopilot");
  add_counts(summary, model_.counts());
  summary.add("armed", model_.armed());
  summary.add("stands on the ground", stands_);
  if (hardest_touch_m_s_ > 0) summary.add("hardest touchdown", hardest_touch_m_s_, "m/s");
}

}  // namespace kestrel::app
