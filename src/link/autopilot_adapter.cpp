#include "kestrel/link/autopilot_adapter.hpp"

#include <stdexcept>
#include <utility>

namespace kestrel {
namespace {

constexpr std::uint8_t kAutopilotComponent = 1;
constexpr std::uint8_t kNoAutopilot = 8;  // MAV_AUTOPILOT_INVALID

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
  for (const auto& [id, rate_hz] :
       {std::pair(30u, options_.attitude_hz), std::pair(32u, options_.position_hz),
        std::pair(245u, 2.0), std::pair(1u, 1.0)}) {
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
