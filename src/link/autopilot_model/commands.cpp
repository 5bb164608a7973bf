// What the stand-in for a flight controller does with commands, and what it tells of its vehicle.
#include <cmath>

#include "kestrel/link/autopilot_model.hpp"

namespace kestrel {
namespace {

constexpr std::uint8_t kAccepted = 0;
constexpr std::uint8_t kTemporarilyRejected = 1;
constexpr std::uint8_t kDenied = 2;
constexpr std::uint8_t kUnsupported = 3;
constexpr std::uint8_t kFailed = 4;

}  // namespace

std::uint8_t AutopilotModel::obey(const mavlink::CommandLong& c, const VehicleTruth& truth,
                                  double now_s) {
  switch (c.command) {
    case kCommandMode:
      return choose_mode(c, truth, now_s);
    case kCommandArm: {
      const bool arm = c.param1 == 1;
      if (!arm && landed(truth) != Landed::OnGround) return kDenied;
      if (arm != armed_) tell(now_s, arm ? "armed" : "disarmed");
      armed_ = arm;
      return kAccepted;
    }
    case kCommandTakeOff:
      if (options_.autopilot == Autopilot::Px4) return kUnsupported;  // its own wants NaNs
      return take_off(c.param7, truth, now_s);
    case kCommandLand:
      enter(profile_.landing_mode, now_s);
      return kAccepted;
    case kCommandInterval: {
      const auto id = std::uint32_t(c.param1);
      if (id != 0 && id != 1 && id != 30 && id != 32 && id != 245) return kFailed;
      if (!(c.param2 > 0)) return kDenied;
      interval_s_[id] = double(c.param2) * 1e-6;
      return kAccepted;
    }
    default:
      return kUnsupported;
  }
}

std::uint8_t AutopilotModel::choose_mode(const mavlink::CommandLong& c, const VehicleTruth& truth,
                                         double now_s) {
  if (c.param1 != 1 || !(c.param2 >= 0 && c.param2 < 256) || !(c.param3 >= 0 && c.param3 < 256)) {
    return kDenied;
  }
  const bool px4 = options_.autopilot == Autopilot::Px4;
  const std::uint32_t wanted =
      px4 ? px4_mode(std::uint32_t(c.param2), std::uint32_t(c.param3)) : std::uint32_t(c.param2);
  if (px4 && wanted == kPx4TakeOff) return take_off(options_.px4_takeoff_m, truth, now_s);
  const bool stream = setpoint_s_ && now_s - *setpoint_s_ <= profile_.setpoint_timeout_s;
  if (px4 && wanted == profile_.control_mode && !stream) {
    tell(now_s, "OFFBOARD refused: no setpoints");
    return kTemporarilyRejected;
  }
  enter(wanted, now_s);
  return kAccepted;
}

std::uint8_t AutopilotModel::take_off(double height_m, const VehicleTruth& truth, double now_s) {
  const bool ardupilot = options_.autopilot == Autopilot::ArduPilot;
  if (!armed_ || !(height_m > 0) || landed(truth) != Landed::OnGround) return kFailed;
  if (ardupilot && mode_ != profile_.control_mode) return kFailed;
  if (!ardupilot) enter(kPx4TakeOff, now_s);
  climb_to_m_ = truth.position_ned_m.z() - height_m;
  tell(now_s, "taking off");
  return kAccepted;
}

void AutopilotModel::climb_or_sink(const VehicleTruth& truth, double now_s) {
  const double down_m = truth.position_ned_m.z();
  if (climb_to_m_) {
    reference_ = {};
    reference_.velocity_ned_m_s.z() = -options_.climb_m_s;
    if (down_m > *climb_to_m_) return;
    climb_to_m_.reset();
    reference_ = {};
    tell(now_s, "the take-off is complete");
    if (profile_.hold_mode) enter(*profile_.hold_mode, now_s);
  } else if (mode_ == profile_.landing_mode && armed_) {
    reference_ = {};
    reference_.velocity_ned_m_s.z() = options_.sink_m_s;
    if (down_m < 0) return;
    armed_ = false;
    reference_ = {};
    tell(now_s, "landed and disarmed");
  }
}

/// The battery pays for time in the air, whatever is flown.
void AutopilotModel::drain(const VehicleTruth& truth, double now_s) {
  const bool flies = armed_ && landed(truth) != Landed::OnGround;
  if (flies && ticked_s_) flown_s_ += now_s - *ticked_s_;
  ticked_s_ = now_s;
}

Landed AutopilotModel::landed(const VehicleTruth& truth) const {
  if (climb_to_m_) return Landed::TakingOff;
  if (truth.position_ned_m.z() >= 0) return Landed::OnGround;
  return mode_ == profile_.landing_mode ? Landed::Landing : Landed::InAir;
}

bool AutopilotModel::is_due(std::uint32_t message_id, double now_s) {
  double& next_s = next_s_.try_emplace(message_id, now_s).first->second;
  if (now_s < next_s) return false;
  const double interval_s = interval_s_.at(message_id);
  next_s = now_s - next_s < interval_s ? next_s + interval_s : now_s + interval_s;
  return true;
}

mavlink::Message AutopilotModel::report(std::uint32_t message_id, const VehicleTruth& truth,
                                        double now_s) const {
  const std::uint32_t boot_ms = time_boot_ms(now_s - options_.boot_s);
  const Eigen::Vector3f p = truth.position_ned_m.cast<float>();
  const Eigen::Vector3f v = truth.velocity_ned_m_s.cast<float>();
  const Eigen::Vector3f w = truth.body_rates_rad_s.cast<float>();
  const Attitude& a = truth.attitude;
  switch (message_id) {
    case 1: {
      const bool flies = armed_ && landed(truth) != Landed::OnGround;
      const BatteryOptions& battery = options_.battery;
      return sys_status(drained(battery, flown_s_, flies ? battery.flying_a : battery.idle_a));
    }
    case 30:
      return mavlink::AttitudeReport{boot_ms, float(a.roll), float(a.pitch), float(a.yaw),
                                     w.x(),   w.y(),         w.z()};
    case 32:
      return mavlink::LocalPosition{boot_ms, p.x(), p.y(), p.z(), v.x(), v.y(), v.z()};
    case 245:
      return mavlink::ExtendedSysState{0, std::uint8_t(landed(truth))};
    default: {
      mavlink::Heartbeat beat;
      beat.custom_mode = mode_;
      beat.type = 4;  // MAV_TYPE_HELICOPTER
      beat.autopilot = options_.autopilot == Autopilot::Px4 ? 12 : 3;
      beat.base_mode = std::uint8_t(1 | (armed_ ? 0x80 : 0));
      beat.system_status = armed_ ? 4 : 3;
      return beat;
    }
  }
}

mavlink::EncodedFrame AutopilotModel::framed(const mavlink::Message& message) {
  return mavlink::encode(message, {options_.me.system_id, options_.me.component_id, sequence_++});
}

}  // namespace kestrel
