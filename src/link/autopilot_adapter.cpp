#include "kestrel/link/autopilot_adapter.hpp"

#include <cmath>
#include <stdexcept>

#include "kestrel/link/setpoint.hpp"

namespace kestrel {
namespace {

constexpr double kHeartbeatPeriod_s = 1;
constexpr double kQuestionPeriod_s = 1;         // about the clock
constexpr double kFirstQuestionPeriod_s = 0.1;  // until it is known well
constexpr int kFirstQuestions = 10;
constexpr std::uint8_t kAutopilotComponent = 1;
constexpr std::uint8_t kNoAutopilot = 8;  // MAV_AUTOPILOT_INVALID
constexpr std::uint8_t kStandby = 3;      // MAV_STATE_STANDBY

/// True each period, without drift and without a burst after a pause.
bool is_due(std::optional<double>& next_s, double period_s, double now_s) {
  if (next_s && now_s < *next_s && *next_s - now_s <= period_s) return false;
  const bool on_time = next_s && now_s - *next_s < period_s && now_s >= *next_s;
  next_s = (on_time ? *next_s : now_s) + period_s;
  return true;
}

}  // namespace

void AutopilotOptions::check() const {
  const auto require = [](bool good, const char* what) {
    if (!good) throw std::invalid_argument(what);
  };
  require(rate_hz >= 10 && rate_hz <= 50, "rate_hz: must be from 10 to 50 (Hz)");
  require(attitude_hz > 0 && attitude_hz <= 400, "attitude_hz: must be positive, up to 400 (Hz)");
  require(position_hz > 0 && position_hz <= 400, "position_hz: must be positive, up to 400 (Hz)");
  require(alive_s > 0 && alive_s <= 5, "alive_s: must be positive, up to 5 (s)");
  require(farewell_s >= 0 && farewell_s <= 5, "farewell_s: must be from 0 to 5 (s)");
  require(component_id != 0, "component_id: must be 1 to 255");
  stream.check();
  handshake.check();
  clock.check();
  telemetry.check();
}

AutopilotAdapter::AutopilotAdapter(const AutopilotOptions& options)
    : options_(options),
      stream_(options.stream),
      handshake_(options.handshake),
      clock_(options.clock),
      telemetry_(options.telemetry) {
  options_.check();
}

void AutopilotAdapter::decide(const VelocityCommand& command, double capture_s, double now_s) {
  if (release_s_) return;
  const std::optional<double> age_before = stream_.age_s(now_s);
  stream_.decide(command, capture_s, now_s);
  const std::optional<double> age_now = stream_.age_s(now_s);
  const bool is_new = age_now && (!age_before || *age_now < *age_before);
  if (is_new && !worked_s_ && options_.handshake.take_control) handshake_.request_control();
  if (is_new) worked_s_ = now_s;
}

void AutopilotAdapter::release(double now_s) {
  if (release_s_) return;
  release_s_ = now_s + options_.farewell_s;
  // Its last word to an autopilot that obeys is zero.
  if (handshake_.wish() != StreamWish::Silence) zeros_until_s_ = release_s_;
}

bool AutopilotAdapter::released() const {
  const bool done = handshake_.state() == HandshakeState::Unseen ||
                    handshake_.state() == HandshakeState::Refused ||
                    handshake_.state() == HandshakeState::Released;
  return release_s_ && !zeros_until_s_ && done;
}

Recipient AutopilotAdapter::vehicle() const {
  return {vehicle_id_.value_or(options_.vehicle == 0 ? 1 : options_.vehicle), kAutopilotComponent};
}

bool AutopilotAdapter::is_vehicle(const mavlink::Packet& packet) {
  const auto* beat = std::get_if<mavlink::Heartbeat>(&packet.message);
  const bool is_autopilot =
      packet.envelope.component_id == kAutopilotComponent && packet.envelope.system_id != 0 &&
      (options_.vehicle == 0 || packet.envelope.system_id == options_.vehicle);
  if (!vehicle_id_ && is_autopilot && beat != nullptr && beat->autopilot != kNoAutopilot) {
    vehicle_id_ = packet.envelope.system_id;
    ask_for_telemetry();
  }
  return is_autopilot && packet.envelope.system_id == vehicle_id_;
}

void AutopilotAdapter::ask_for_telemetry() {
  intervals_.clear();
  for (const auto& [id, rate_hz] : {std::pair(30u, options_.attitude_hz),
                                    std::pair(32u, options_.position_hz), std::pair(245u, 2.0)}) {
    intervals_.emplace_back(interval_request(id, rate_hz, vehicle()), options_.handshake.request);
  }
}

AutopilotAdapter::Frames AutopilotAdapter::receive(Bytes datagram, double now_s) {
  Frames answers;
  for (Bytes rest = datagram; rest.size > 0;) {
    const mavlink::Decoded decoded = mavlink::decode(rest);
    rest = rest.after(decoded.size);
    if (const auto* packet = std::get_if<mavlink::Packet>(&decoded.content)) {
      take(*packet, now_s, answers);
    } else if (std::get<mavlink::Refusal>(decoded.content) != mavlink::Refusal::UnknownMessage) {
      ++counts_.malformed;
    }
  }
  return answers;
}

void AutopilotAdapter::take(const mavlink::Packet& packet, double now_s, Frames& answers) {
  const bool ours = is_vehicle(packet);
  ++(ours ? counts_.received : counts_.foreign);
  if (const auto* time = std::get_if<mavlink::TimeSync>(&packet.message)) {
    if (const auto answer = time_answer(*time, vehicle().system_id, options_.component_id, now_s)) {
      answers.push_back(framed(*answer));
    } else if (ours) {
      const ClockAnswer result = clock_.take(*time, now_s);
      answered_ = result == ClockAnswer::Jumped ? 1 : answered_ + 1;
      // The vehicle has started anew, and forgotten what it was asked.
      if (result == ClockAnswer::Jumped) ask_for_telemetry();
    }
  }
  if (!ours) return;
  if (const auto* ack = std::get_if<mavlink::CommandAck>(&packet.message)) {
    const bool for_us =
        (ack->target_system == 0 || ack->target_system == vehicle().system_id) &&
        (ack->target_component == 0 || ack->target_component == options_.component_id);
    if (!for_us) return;
    handshake_.acknowledge(*ack, now_s);
    if (!intervals_.empty()) intervals_.front().acknowledge(*ack, now_s);
  }
  telemetry_.take(packet.message, now_s, clock_.estimate(now_s));
}

AutopilotAdapter::Frames AutopilotAdapter::tick(double now_s) {
  Frames due;
  send_commands(now_s, due);
  send_setpoint(now_s, due);
  send_heartbeat(now_s, due);
  send_questions(now_s, due);
  return due;
}

void AutopilotAdapter::send_commands(double now_s, Frames& due) {
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

mavlink::EncodedFrame AutopilotAdapter::framed(const mavlink::Message& message) {
  return mavlink::encode(message, {vehicle().system_id, options_.component_id, sequence_++});
}

AdapterStatus AutopilotAdapter::status(double now_s) const {
  AdapterStatus status;
  status.control = handshake_.state();
  status.words = handshake_.words();
  if (handshake_.profile()) status.autopilot = handshake_.profile()->autopilot;
  status.vehicle = telemetry_.state();
  status.stream = stream_.state(now_s);
  status.clock = clock_.estimate(now_s);
  status.clock_jumps = clock_.jumps();
  status.counts = counts_;
  status.decided = stream_.counts();
  status.telemetry = telemetry_.counts();
  return status;
}

}  // namespace kestrel
