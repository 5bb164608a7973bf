// What is asked of the autopilot, one step after the other.
#include <string>

#include "kestrel/link/handshake.hpp"

namespace kestrel {

Handshake::Command Handshake::pursue(const VehicleState& vehicle, const Recipient& to,
                                     double now_s) {
  switch (goal_) {
    case Goal::None:
      return std::nullopt;
    case Goal::Control:
      return pursue_control(vehicle, to, now_s);
    case Goal::Landing:
      if (vehicle.landed == Landed::OnGround || !is_armed(vehicle.heartbeat)) {
        end(HandshakeState::Released, "landed");
        return std::nullopt;
      }
      if (vehicle.heartbeat.custom_mode == profile_->landing_mode) return std::nullopt;
      return ask(Step::Land, mode_request(*profile_, profile_->landing_mode, to), now_s);
    case Goal::GiveBack:
      if (vehicle.heartbeat.custom_mode != profile_->control_mode) {
        end(HandshakeState::Released, "control was given back");
        return std::nullopt;
      }
      return ask(Step::Hold, mode_request(*profile_, *profile_->hold_mode, to), now_s);
  }
  return std::nullopt;
}

Handshake::Command Handshake::pursue_control(const VehicleState& vehicle, const Recipient& to,
                                             double now_s) {
  if (!mode_before_) {
    mode_before_ = vehicle.heartbeat.custom_mode;
    takes_off_ = vehicle.landed == Landed::OnGround || !is_armed(vehicle.heartbeat);
    ground_m_ = vehicle.down_m.value_or(0);
    if (takes_off_ && !may_take_off(vehicle)) return std::nullopt;
    state_ = HandshakeState::Asking;
  }
  if (takes_off_) return pursue_takeoff(vehicle, to, now_s);
  if (!is_armed(vehicle.heartbeat)) {
    end(HandshakeState::Refused, "the vehicle was disarmed while control was asked for");
    return std::nullopt;
  }
  return mode(vehicle, to, now_s);
}

bool Handshake::may_take_off(const VehicleState& vehicle) {
  const std::string where =
      is_armed(vehicle.heartbeat) ? "the vehicle stands on the ground" : "the vehicle is not armed";
  if (options_.takeoff_m > 0) return true;  // check() has seen to allow_arming
  end(HandshakeState::Refused,
      where + (options_.allow_arming ? ", and no height to take off to was given (takeoff_m)"
                                     : ", and arming is not allowed (allow_arming)"));
  return false;
}

Handshake::Command Handshake::mode(const VehicleState& vehicle, const Recipient& to, double now_s) {
  if (vehicle.heartbeat.custom_mode == profile_->control_mode) {
    if (!takes_off_) {
      end(HandshakeState::InControl,
          "in control: " + mode_name(profile_->autopilot, profile_->control_mode));
    }
    return std::nullopt;
  }
  if (step_ != Step::Mode && profile_->stream_first_s > 0) {
    if (step_ != Step::Stream) {
      step_ = Step::Stream;
      step_began_s_ = now_s;
    }
    if (now_s - step_began_s_ < profile_->stream_first_s) return std::nullopt;
  }
  return ask(Step::Mode, mode_request(*profile_, profile_->control_mode, to), now_s);
}

Handshake::Command Handshake::pursue_takeoff(const VehicleState& vehicle, const Recipient& to,
                                             double now_s) {
  if (climb_began_s_) return climb(vehicle, now_s);
  const bool mode_first = profile_->autopilot == Autopilot::ArduPilot;
  if (mode_first && vehicle.heartbeat.custom_mode != profile_->control_mode) {
    return mode(vehicle, to, now_s);
  }
  if (!is_armed(vehicle.heartbeat)) return ask(Step::Arm, arm_request(to), now_s);
  if (step_ == Step::TakeOff && request_->state() == RequestState::Accepted) {
    climb_began_s_ = now_s;
    state_ = HandshakeState::Climbing;
    words_ = "taking off";
    return std::nullopt;
  }
  return ask(Step::TakeOff, takeoff_request(*profile_, options_.takeoff_m, to), now_s);
}

bool Handshake::is_up(const VehicleState& vehicle) const {
  constexpr double kEnough = 0.9;  // of the height asked for
  if (vehicle.landed == Landed::OnGround || vehicle.landed == Landed::TakingOff) return false;
  // PX4 climbs to a height of its own, and then holds.
  if (profile_->autopilot == Autopilot::Px4) return vehicle.heartbeat.custom_mode == kPx4Hold;
  return vehicle.down_m && ground_m_ - *vehicle.down_m >= kEnough * options_.takeoff_m;
}

Handshake::Command Handshake::climb(const VehicleState& vehicle, double now_s) {
  if (is_up(vehicle)) {
    takes_off_ = false;
    mode_before_ = vehicle.heartbeat.custom_mode;
    state_ = HandshakeState::Asking;
    step_.reset();
    request_.reset();
  } else if (!is_armed(vehicle.heartbeat)) {
    end(HandshakeState::Released, "the vehicle was disarmed while it took off");
  } else if (now_s - *climb_began_s_ > options_.climb_s) {
    end(HandshakeState::Refused, "the take-off has not reached its height in time");
  }
  return std::nullopt;
}

Handshake::Command Handshake::ask(Step step, const mavlink::CommandLong& command, double now_s) {
  if (step_ != step || !request_) {
    step_ = step;
    request_.emplace(command, options_.request);
    words_ = "asking: " + command_name(command.command);
  }
  const Command due = request_->due(now_s);
  const bool forgotten = request_->state() == RequestState::Accepted && step != Step::TakeOff &&
                         now_s - request_->accepted_s() > options_.confirm_s;
  if (request_->state() == RequestState::Refused || forgotten) {
    const std::string why =
        forgotten ? command_name(command.command) + ": accepted, but not done" : request_->words();
    end(goal_ == Goal::GiveBack ? HandshakeState::Released : HandshakeState::Refused, why);
    return std::nullopt;
  }
  return due;
}

}  // namespace kestrel
