#include "kestrel/link/handshake.hpp"

#include <cmath>
#include <stdexcept>

namespace kestrel {

void HandshakeOptions::check() const {
  const auto require = [](bool good, const char* what) {
    if (!good) throw std::invalid_argument(what);
  };
  require(takeoff_m >= 0 && std::isfinite(takeoff_m),
          "takeoff_m: must be finite and not negative (m)");
  require(takeoff_m == 0 || (allow_arming && take_control),
          "takeoff_m: wants allow_arming and take_control");
  require(confirm_s > 0 && std::isfinite(confirm_s), "confirm_s: must be finite and positive (s)");
  require(climb_s > 0 && std::isfinite(climb_s), "climb_s: must be finite and positive (s)");
  require(lost_s > 0 && std::isfinite(lost_s), "lost_s: must be finite and positive (s)");
  request.check();
}

const char* name(HandshakeState state) {
  constexpr const char* kNames[] = {"unseen",  "seen",        "asking",   "climbing", "in control",
                                    "landing", "giving back", "released", "refused"};
  return kNames[std::size_t(state)];
}

Handshake::Handshake(const HandshakeOptions& options) : options_(options) { options_.check(); }

void Handshake::end(HandshakeState state, const std::string& words) {
  state_ = state;
  words_ = words;
  goal_ = Goal::None;
  step_.reset();
  request_.reset();
  mode_before_.reset();
  climb_began_s_.reset();
  takes_off_ = false;
}

void Handshake::request_control() {
  if (!options_.take_control) {
    words_ = "take_control is off: the pilot chooses the mode";
  } else if (goal_ != Goal::Control && state_ != HandshakeState::InControl) {
    const bool is_heard = profile_ && state_ != HandshakeState::Unseen;
    end(is_heard ? HandshakeState::Seen : HandshakeState::Unseen,
        is_heard ? "control is asked for" : "no autopilot has been heard");
    goal_ = Goal::Control;
  }
}

void Handshake::request_landing() {
  if (!options_.allow_arming) {
    words_ = "landing is not asked for: allow_arming is off";
  } else if (state_ != HandshakeState::InControl) {
    words_ = "landing is not asked for: we are not in control";
  } else {
    end(HandshakeState::Landing, "landing");
    goal_ = Goal::Landing;
  }
}

void Handshake::release() {
  const bool was_in_control = state_ == HandshakeState::InControl;
  if (state_ == HandshakeState::Unseen || state_ == HandshakeState::Released) {
    goal_ = Goal::None;
  } else if (was_in_control && options_.take_control && profile_->hold_mode) {
    end(HandshakeState::GivingBack, "control is being given back");
    goal_ = Goal::GiveBack;
  } else {
    end(HandshakeState::Released,
        was_in_control ? "control was given back" : "nothing is asked for");
  }
}

void Handshake::acknowledge(const mavlink::CommandAck& answer, double now_s) {
  if (request_) request_->acknowledge(answer, now_s);
}

StreamWish Handshake::wish() const {
  switch (state_) {
    case HandshakeState::InControl:
      return StreamWish::Commands;
    case HandshakeState::GivingBack:
      return StreamWish::Zeros;
    case HandshakeState::Asking:
      // Its mode may change before its heartbeat says so; and PX4 wants the stream first. While it
      // takes off it must not hear a setpoint.
      return step_ == Step::Mode || step_ == Step::Stream ? StreamWish::Zeros : StreamWish::Silence;
    case HandshakeState::Seen: {
      const bool stream_first = profile_ && profile_->stream_first_s > 0;
      return !options_.take_control && stream_first ? StreamWish::Zeros : StreamWish::Silence;
    }
    default:
      return StreamWish::Silence;
  }
}

Handshake::Command Handshake::tick(const std::optional<VehicleState>& vehicle, const Recipient& to,
                                   double now_s) {
  if (!is_there(vehicle, now_s)) return std::nullopt;
  watch(*vehicle);
  return pursue(*vehicle, to, now_s);
}

bool Handshake::is_there(const std::optional<VehicleState>& vehicle, double now_s) {
  if (!vehicle) return false;
  if (!(now_s - vehicle->heard_s <= options_.lost_s)) {
    if (state_ != HandshakeState::Unseen) {
      end(HandshakeState::Unseen, "the autopilot is no longer heard");
    }
    return false;
  }
  const std::optional<Autopilot> autopilot = autopilot_of(vehicle->heartbeat);
  if (!autopilot) {
    if (state_ != HandshakeState::Refused) {
      end(HandshakeState::Refused, "the vehicle is neither an ArduPilot nor a PX4 with rotors");
    }
    return false;
  }
  profile_ = profile_of(*autopilot);
  if (state_ == HandshakeState::Unseen) {
    state_ = HandshakeState::Seen;
    if (goal_ == Goal::None) words_ = std::string(kestrel::name(*autopilot)) + " is heard";
  }
  return true;
}

void Handshake::watch(const VehicleState& vehicle) {
  const std::uint32_t now = vehicle.heartbeat.custom_mode;
  const std::string now_name = mode_name(profile_->autopilot, now);
  const bool obeys = now == profile_->control_mode && is_armed(vehicle.heartbeat);
  if (state_ == HandshakeState::InControl && !obeys) {
    const std::string why = now == profile_->control_mode ? "the vehicle was disarmed"
                                                          : "the mode was changed to " + now_name;
    end(options_.take_control ? HandshakeState::Released : HandshakeState::Seen,
        why + " by somebody else: control is theirs");
  } else if (state_ == HandshakeState::Seen && !options_.take_control && obeys) {
    end(HandshakeState::InControl, "the pilot chose " + now_name);
  } else if (state_ == HandshakeState::Landing) {
    if (now == profile_->control_mode || now == profile_->landing_mode) return;
    end(HandshakeState::Released, "the mode was changed to " + now_name + " by somebody else");
  } else if (state_ == HandshakeState::Asking || state_ == HandshakeState::Climbing) {
    const bool is_takeoff = takes_off_ && (now == kPx4TakeOff || now == kPx4Hold) &&
                            profile_->autopilot == Autopilot::Px4;
    if (now == *mode_before_ || now == profile_->control_mode || is_takeoff) return;
    end(HandshakeState::Released,
        "the mode was changed to " + now_name + " by somebody else while control was asked for");
  }
}

}  // namespace kestrel
