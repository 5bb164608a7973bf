#include "kestrel/link/command_desk.hpp"

#include <algorithm>

namespace kestrel {

bool is_switch_control(std::uint16_t command) {
  return command >= std::uint16_t(SwitchControl::TakeOver) &&
         command <= std::uint16_t(SwitchControl::Reset);
}

CommandDesk::CommandDesk(const CommandDeskOptions& options)
    : options_(options),
      // A silence in which control is lost in any case, before a clock may be learned anew.
      guard_(
          {options.envelope.speed, options.time_to_live_s, std::max(2.0, 2 * options.deadman_s)}),
      arbiter_(options.dead_after_s),
      stream_(options.envelope, options.period_s) {}

std::optional<Refused> CommandDesk::setpoint(const Claimant& from,
                                             const mavlink::SetPositionTarget& setpoint,
                                             Arrival arrival, double now_s) {
  settle(now_s);
  const auto verdict = guard_.check(from.id, setpoint, arrival, now_s);
  if (const auto* reason = std::get_if<Refused>(&verdict)) return *reason;
  const auto& guarded = std::get<GuardedSetpoint>(verdict);
  const double fresh_until_s =
      std::min(now_s + options_.deadman_s, guarded.captured_s + options_.time_to_live_s);
  if (const auto reason = arbiter_.offer(from, fresh_until_s, now_s)) return reason;
  look_who_owns();
  if (owes_zero_) return std::nullopt;  // that comes first
  stream_.want({guarded.command, guarded.captured_s}, fresh_until_s);
  fresh_until_s_ = fresh_until_s;
  must_send_ = true;
  return std::nullopt;
}

void CommandDesk::look_who_owns() {
  if (arbiter_.owner() == owner_) return;
  owner_ = arbiter_.owner();
  send_zero();
}

void CommandDesk::send_zero() {
  fresh_until_s_.reset();
  stream_.want_zero();
  must_send_ = owes_zero_ = true;
}

bool CommandDesk::control(SwitchControl what) {
  switch (what) {
    case SwitchControl::Lock:
      return arbiter_.lock();
    case SwitchControl::TakeOver:
      arbiter_.take_over();
      break;
    case SwitchControl::Release:
      arbiter_.release();
      break;
    case SwitchControl::EmergencyStop:
      arbiter_.stop();
      break;
    case SwitchControl::Reset:
      if (closed_) return false;
      arbiter_.reset();
      break;
  }
  look_who_owns();
  send_zero();
  return true;
}

void CommandDesk::forget(PeerId peer, double now_s) {
  guard_.forget(peer);
  if (owner_ && owner_->peer == peer) send_zero();  // also when control stays locked to it
  arbiter_.forget(peer, now_s);
  look_who_owns();
}

void CommandDesk::close() {
  control(SwitchControl::EmergencyStop);
  closed_ = true;
}

/// What time alone brings about.
void CommandDesk::settle(double now_s) {
  if (fresh_until_s_ && now_s >= *fresh_until_s_) {
    ++deadman_count_;
    send_zero();
  }
  arbiter_.update(now_s);
  look_who_owns();
}

std::optional<FlightSetpoint> CommandDesk::due(double now_s) {
  settle(now_s);
  if (!must_send_ && !stream_.is_due(now_s)) return std::nullopt;
  must_send_ = owes_zero_ = false;
  return stream_.next(now_s);
}

}  // namespace kestrel
