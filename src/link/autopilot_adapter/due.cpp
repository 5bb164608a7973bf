// What is sent when: commands, setpoints, heartbeats, questions about the clock.
#include "kestrel/link/autopilot_adapter.hpp"
#include "kestrel/link/setpoint.hpp"

namespace kestrel {
namespace {

constexpr double kHeartbeatPeriod_s = 1;
constexpr double kQuestionPeriod_s = 1;         // about the clock
constexpr double kFirstQuestionPeriod_s = 0.1;  // until it is known well
constexpr int kFirstQuestions = 10;
constexpr std::uint8_t kStandby = 3;  // MAV_STATE_STANDBY

/// True each period, without drift and without a burst after a pause.
bool is_due(std::optional<double>& next_s, double period_s, double now_s) {
  if (next_s && now_s < *next_s && *next_s - now_s <= period_s) return false;
  const bool on_time = next_s && now_s - *next_s < period_s && now_s >= *next_s;
  next_s = (on_time ? *next_s : now_s) + period_s;
  return true;
}

}  // namespace

AutopilotAdapter::Frames AutopilotAdapter::tick(double now_s) {
  Frames due;
  ticked_.reset();
  // Without the handshake nothing is ever asked for, and there is no leave to stream.
  if (options_.part == AdapterPart::Pilot) send_handshake(now_s, due);
  send_commands(now_s, due);
  send_setpoint(now_s, due);
  send_heartbeat(now_s, due);
  send_questions(now_s, due);
  return due;
}

void AutopilotAdapter::send_handshake(double now_s, Frames& due) {
  if (release_s_ && now_s >= *release_s_) {
    zeros_until_s_.reset();
    if (handshake_.state() != HandshakeState::GivingBack &&
        handshake_.state() != HandshakeState::Released) {
      handshake_.release();
    }
  }
  const StreamWish before = handshake_.wish();
  if (const auto command = handshake_.tick(telemetry_.state(), vehicle(), now_s)) {
    due.push_back(framed(*command));
    ++counts_.commands;
  }
  const bool lost = handshake_.state() == HandshakeState::Unseen && before == StreamWish::Commands;
  if (lost && !zeros_until_s_) zeros_until_s_ = now_s + options_.farewell_s;
}

void AutopilotAdapter::send_commands(double now_s, Frames& due) {
  while (!intervals_.empty()) {
    if (const auto command = intervals_.front().due(now_s)) {
      due.push_back(framed(*command));
      ++counts_.commands;
    }
    if (intervals_.front().state() == RequestState::Open) break;
    intervals_.pop_front();
  }
}

std::optional<StreamSetpoint> AutopilotAdapter::setpoint(double now_s) {
  if (zeros_until_s_ && now_s >= *zeros_until_s_) zeros_until_s_.reset();
  const StreamSetpoint zeros{VelocityCommand::hover(), now_s, StreamState::Zero};
  if (zeros_until_s_) return zeros;
  switch (handshake_.wish()) {
    case StreamWish::Silence:
      return std::nullopt;
    case StreamWish::Zeros:
      return zeros;
    case StreamWish::Commands:
      return stream_.at(now_s);
  }
  return std::nullopt;
}

void AutopilotAdapter::send_setpoint(double now_s, Frames& due) {
  if (!is_due(next_setpoint_s_, 1 / options_.rate_hz, now_s)) return;
  const std::optional<StreamSetpoint> wanted = setpoint(now_s);
  if (!wanted) return;
  const mavlink::SetPositionTarget message =
      velocity_setpoint(wanted->command, time_boot_ms(wanted->stamp_s), vehicle());
  ++counts_.setpoints;
  ticked_ = wanted;
  if (wanted->command.vector().isZero(0)) ++counts_.zeros;
  due.push_back(framed(message));
}

void AutopilotAdapter::send_heartbeat(double now_s, Frames& due) {
  if (worked_s_ && !(now_s - *worked_s_ <= options_.alive_s)) return;
  if (!is_due(next_heartbeat_s_, kHeartbeatPeriod_s, now_s)) return;
  mavlink::Heartbeat beat;
  if (!worked_s_) beat.system_status = kStandby;
  ++counts_.heartbeats;
  due.push_back(framed(beat));
}

void AutopilotAdapter::send_questions(double now_s, Frames& due) {
  const double period_s =
      answered_ < kFirstQuestions && vehicle_id_ ? kFirstQuestionPeriod_s : kQuestionPeriod_s;
  if (is_due(next_question_s_, period_s, now_s)) due.push_back(framed(clock_.ask(now_s)));
}

}  // namespace kestrel
