#include "kestrel/link/receiver_state.hpp"

#include <algorithm>
#include <numeric>

namespace kestrel {
namespace {

bool concerns(std::uint8_t target, std::uint8_t me) { return target == 0 || target == me; }

}  // namespace

long ReceiverCounts::malformed() const {
  return std::accumulate(refused.begin(), refused.end(), 0L) -
         refused_as(mavlink::Refusal::UnknownMessage);
}

std::vector<ReceivedCommand> ReceiverState::take(Bytes datagram, const Address& from) {
  ++counts_.datagrams;
  std::vector<ReceivedCommand> commands;
  Bytes rest = datagram;
  do {  // once also for an empty datagram, which is refused
    const mavlink::Decoded decoded = mavlink::decode(rest);
    rest = rest.after(decoded.size);
    if (const auto* refusal = std::get_if<mavlink::Refusal>(&decoded.content)) {
      ++counts_.refused[std::size_t(*refusal)];
    } else if (const auto command = accept(std::get<mavlink::Packet>(decoded.content), from)) {
      commands.push_back(*command);
    }
  } while (rest.size > 0);
  counts_.commands += long(commands.size());
  return commands;
}

std::optional<ReceivedCommand> ReceiverState::accept(const mavlink::Packet& packet,
                                                     const Address& from) {
  if (!is_new(packet.envelope, from)) return std::nullopt;
  if (const auto* setpoint = std::get_if<mavlink::SetPositionTarget>(&packet.message)) {
    return accept_setpoint(*setpoint, packet.envelope);
  }
  if (std::holds_alternative<mavlink::Heartbeat>(packet.message)) ++counts_.heartbeats;
  return std::nullopt;
}

std::optional<ReceivedCommand> ReceiverState::accept_setpoint(
    const mavlink::SetPositionTarget& setpoint, const mavlink::Envelope& envelope) {
  if (!concerns(setpoint.target_system, me_.system_id) ||
      !concerns(setpoint.target_component, me_.component_id)) {
    ++counts_.misaddressed;
    return std::nullopt;
  }
  const std::optional<VelocityCommand> command = velocity_of(setpoint);
  if (!command) {
    ++(is_finite(setpoint) ? counts_.unsupported : counts_.not_finite);
    return std::nullopt;
  }
  return ReceivedCommand{*command, setpoint.time_boot_ms, envelope};
}

bool ReceiverState::is_new(const mavlink::Envelope& envelope, const Address& from) {
  Sender& who = sender({from, envelope.system_id, envelope.component_id});
  who.last_heard = counts_.datagrams;
  const long lost_before = who.sequence.lost();
  const Arrival arrival = who.sequence.arrive(envelope.sequence);
  counts_.lost += who.sequence.lost() - lost_before;
  if (arrival == Arrival::Late) ++counts_.late;
  if (arrival == Arrival::Duplicate) ++counts_.duplicates;
  return arrival == Arrival::New;
}

ReceiverState::Sender& ReceiverState::sender(const SenderId& id) {
  const auto known = senders_.find(id);
  if (known != senders_.end()) return known->second;
  if (senders_.size() >= kMaxSenders) {
    senders_.erase(std::min_element(
        senders_.begin(), senders_.end(),
        [](const auto& a, const auto& b) { return a.second.last_heard < b.second.last_heard; }));
  }
  return senders_[id];
}

}  // namespace kestrel
