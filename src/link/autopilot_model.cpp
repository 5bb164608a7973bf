#include "kestrel/link/autopilot_model.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace kestrel {
namespace {

constexpr std::uint8_t kLocalNed = 1;
constexpr std::uint8_t kBodyOffsetNed = 9;
constexpr std::uint8_t kBodyFrd = 12;
constexpr std::uint16_t kVelocityOnly = 0xDC7;
constexpr std::size_t kMaxEvents = 1000;

bool concerns(std::uint8_t target, std::uint8_t me) { return target == 0 || target == me; }

/// Of an axis that is not finite nothing is wanted.
double or_zero(float value) { return std::isfinite(value) ? double(value) : 0; }

MotionReference reference_of(const mavlink::SetPositionTarget& s, double yaw) {
  MotionReference wanted;
  const double x = or_zero(s.vx_m_s);
  const double y = or_zero(s.vy_m_s);
  wanted.velocity_ned_m_s = {x, y, or_zero(s.vz_m_s)};
  if (s.coordinate_frame == kHeadingFrame || s.coordinate_frame == kBodyOffsetNed) {
    wanted.velocity_ned_m_s.x() = std::cos(yaw) * x - std::sin(yaw) * y;
    wanted.velocity_ned_m_s.y() = std::sin(yaw) * x + std::cos(yaw) * y;
  }
  if (s.type_mask == kVelocityAndYawRate) wanted.yaw_rate_rad_s = or_zero(s.yaw_rate_rad_s);
  if (s.coordinate_frame == kBodyFrd) wanted = {};
  return wanted;
}

}  // namespace

void AutopilotModelOptions::check() const {
  const auto require = [](bool good, const char* what) {
    if (!good) throw std::invalid_argument(what);
  };
  require(me.system_id != 0 && me.component_id != 0, "me: ids must be 1 to 255");
  require(std::isfinite(boot_s), "boot_s: must be finite (s)");
  require(climb_m_s > 0 && std::isfinite(climb_m_s), "climb_m_s: must be positive (m/s)");
  require(sink_m_s > 0 && std::isfinite(sink_m_s), "sink_m_s: must be positive (m/s)");
  require(px4_takeoff_m > 0 && std::isfinite(px4_takeoff_m), "px4_takeoff_m: must be positive (m)");
  require(telemetry_hz > 0 && std::isfinite(telemetry_hz), "telemetry_hz: must be positive (Hz)");
  battery.check();
}

AutopilotModel::AutopilotModel(const AutopilotModelOptions& options)
    : options_(options),
      profile_(profile_of(options.autopilot)),
      mode_(options.start_mode.value_or(options.autopilot == Autopilot::Px4 ? kPx4Hold : 5)),
      armed_(options.starts_armed) {
  options_.check();
  interval_s_ = {
      {0, 1.0}, {1, 1.0}, {30, 1 / options_.telemetry_hz}, {32, 1 / options_.telemetry_hz}};
  if (options_.autopilot == Autopilot::Px4) interval_s_[245] = 0.5;  // ArduPilot waits to be asked
}

AutopilotModel::Frames AutopilotModel::receive(Bytes datagram, const VehicleTruth& truth,
                                               double now_s) {
  Frames answers;
  for (Bytes rest = datagram; alive_ && rest.size > 0;) {
    const mavlink::Decoded decoded = mavlink::decode(rest);
    rest = rest.after(decoded.size);
    if (const auto* packet = std::get_if<mavlink::Packet>(&decoded.content)) {
      take(*packet, truth, now_s, answers);
    } else {
      ++counts_.malformed;
    }
  }
  return answers;
}

void AutopilotModel::take(const mavlink::Packet& packet, const VehicleTruth& truth, double now_s,
                          Frames& answers) {
  if (const auto* setpoint = std::get_if<mavlink::SetPositionTarget>(&packet.message)) {
    obey(*setpoint, truth, now_s);
  } else if (const auto* command = std::get_if<mavlink::CommandLong>(&packet.message)) {
    if (!concerns(command->target_system, options_.me.system_id) ||
        !concerns(command->target_component, options_.me.component_id)) {
      ++counts_.misaddressed;
      return;
    }
    ++counts_.commands;
    mavlink::CommandAck ack;
    ack.command = command->command;
    ack.result = obey(*command, truth, now_s);
    ack.target_system = packet.envelope.system_id;
    ack.target_component = packet.envelope.component_id;
    answers.push_back(framed(ack));
  } else if (const auto* time = std::get_if<mavlink::TimeSync>(&packet.message)) {
    const auto answer = time_answer(*time, options_.me.system_id, options_.me.component_id,
                                    now_s - options_.boot_s);
    if (answer) answers.push_back(framed(*answer));
  } else if (std::holds_alternative<mavlink::Heartbeat>(packet.message)) {
    ++counts_.heartbeats;
  }
}

void AutopilotModel::obey(const mavlink::SetPositionTarget& setpoint, const VehicleTruth& truth,
                          double now_s) {
  if (!concerns(setpoint.target_system, options_.me.system_id) ||
      !concerns(setpoint.target_component, options_.me.component_id)) {
    ++counts_.misaddressed;
    return;
  }
  ++counts_.setpoints;
  if (!accepts(setpoint, now_s)) return;
  setpoint_s_ = now_s;
  if (mode_ != profile_.control_mode || !armed_) {
    ++counts_.ignored;
    return;
  }
  if (climb_to_m_ && profile_.setpoint_ends_takeoff) {
    climb_to_m_.reset();
    tell(now_s, "a setpoint has ended the take-off");
  }
  ++counts_.obeyed;
  reference_ = reference_of(setpoint, truth.attitude.yaw);
}

bool AutopilotModel::accepts(const mavlink::SetPositionTarget& s, double now_s) {
  const bool ardupilot = options_.autopilot == Autopilot::ArduPilot;
  const bool portable = s.coordinate_frame == kHeadingFrame || s.coordinate_frame == kLocalNed;
  const bool own = s.coordinate_frame == kBodyOffsetNed || s.coordinate_frame == kBodyFrd;
  if (!portable && !(ardupilot && own)) {
    ++counts_.refused;
    tell(now_s, "setpoint refused: frame " + std::to_string(s.coordinate_frame));
    return false;
  }
  if (s.type_mask != kVelocityAndYawRate && s.type_mask != kVelocityOnly) {
    ++counts_.ignored;
    return false;
  }
  const bool finite = std::isfinite(s.vx_m_s) && std::isfinite(s.vy_m_s) &&
                      std::isfinite(s.vz_m_s) &&
                      (s.type_mask == kVelocityOnly || std::isfinite(s.yaw_rate_rad_s));
  if (finite) return true;
  ++counts_.not_finite;
  tell(now_s, ardupilot ? "a number that is not finite: the process has aborted"
                        : "a number that is not finite: the axis is ignored");
  if (ardupilot) alive_ = false;
  return alive_;
}

AutopilotModel::Frames AutopilotModel::tick(const VehicleTruth& truth, double now_s) {
  if (!alive_) return {};
  time_out(now_s);
  climb_or_sink(truth, now_s);
  drain(truth, now_s);
  Frames due;
  for (const auto& [id, interval_s] : interval_s_) {
    if (is_due(id, now_s)) due.push_back(framed(report(id, truth, now_s)));
  }
  return due;
}

void AutopilotModel::time_out(double now_s) {
  if (mode_ != profile_.control_mode || climb_to_m_ || !setpoint_s_) return;
  if (now_s - *setpoint_s_ <= profile_.setpoint_timeout_s) return;
  setpoint_s_.reset();
  reference_ = {};
  if (profile_.hold_mode) {
    tell(now_s, "no setpoint: failsafe");
    enter(*profile_.hold_mode, now_s);
  } else {
    tell(now_s, "no setpoint: stopping");
  }
}

void AutopilotModel::pilot_chooses(std::uint32_t mode, double now_s) {
  tell(now_s, "the pilot's switch");
  enter(mode, now_s);
}

void AutopilotModel::enter(std::uint32_t mode, double now_s) {
  if (mode == mode_) return;
  mode_ = mode;
  reference_ = {};
  climb_to_m_.reset();
  tell(now_s, "mode " + mode_name(options_.autopilot, mode));
}

void AutopilotModel::tell(double now_s, const std::string& what) {
  if (events_.size() < kMaxEvents) events_.push_back({now_s, what});
}

std::vector<AutopilotEvent> AutopilotModel::take_events() { return std::exchange(events_, {}); }

}  // namespace kestrel
