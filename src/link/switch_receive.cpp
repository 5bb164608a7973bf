// The receiving half of SwitchCore: from bytes to what is obeyed, passed on or refused.
#include <algorithm>
#include <string>

#include "kestrel/link/flight_rules.hpp"
#include "kestrel/link/switch_core.hpp"

namespace kestrel {
namespace {

using mavlink::FrameView;
using Reason = std::optional<Refused>;

constexpr std::uint32_t kHeartbeat = 0, kCommandLong = 76, kSetpoint = 84, kSetupSigning = 256;

bool concerns(std::uint8_t target, std::uint8_t me) { return target == 0 || target == me; }

SwitchEventKind event_of(SwitchControl what) {
  constexpr SwitchEventKind kKinds[] = {SwitchEventKind::TakenOver, SwitchEventKind::Locked,
                                        SwitchEventKind::Released, SwitchEventKind::EmergencyStop,
                                        SwitchEventKind::Reset};
  return kKinds[std::size_t(what) - std::size_t(SwitchControl::TakeOver)];
}

template <class M>
M read(const FrameView& frame) {
  return std::get<M>(*mavlink::message_of(frame.message_id(), frame.payload()));
}

}  // namespace

const std::vector<Delivery>& SwitchCore::receive(PeerId id, Bytes bytes, SwitchTime time) {
  outbox_.start(time.unix_s);
  send_due(time);  // what time alone has brought about comes before what is new
  const auto found = peers_.find(id);
  if (found == peers_.end()) {
    ++unknown_peer_chunks_;
    return outbox_.deliveries();
  }
  Peer& peer = found->second;
  ++peer.status.counters.chunks;
  peer.status.counters.bytes += bytes.size;
  if (peer.stream) {
    receive_stream(peer, bytes, time);
  } else {
    receive_datagram(peer, bytes, time);
  }
  return outbox_.deliveries();
}

void SwitchCore::receive_datagram(Peer& peer, Bytes bytes, SwitchTime time) {
  while (bytes.size > 0) {
    if (!peer.bucket.take(time.now_s)) {
      count(peer, Refused::TooFast, time);
      return;  // what is left is not worth the time of reading it
    }
    const mavlink::Parsed parsed = mavlink::parse(bytes);
    take(peer, parsed, time);
    bytes = bytes.after(parsed.size);
  }
}

void SwitchCore::receive_stream(Peer& peer, Bytes bytes, SwitchTime time) {
  while (bytes.size > 0) {
    bytes = peer.stream->push(bytes);
    while (const auto parsed = peer.stream->next()) {
      if (peer.bucket.take(time.now_s)) {
        take(peer, *parsed, time);
      } else {
        count(peer, Refused::TooFast, time);
      }
    }
  }
}

void SwitchCore::count(Peer& peer, Refused reason, SwitchTime time) {
  const auto times = ++peer.status.counters.refused[std::size_t(reason)];
  log_.refused(time.now_s, peer.status.peer, reason, times);
}

void SwitchCore::take(Peer& peer, const mavlink::Parsed& parsed, SwitchTime time) {
  const auto* frame = std::get_if<FrameView>(&parsed.content);
  const std::uint64_t forwarded = peer.status.counters.forwarded;
  const Reason reason = frame != nullptr ? take_frame(peer, *frame, time)
                                         : refused_for(std::get<mavlink::Refusal>(parsed.content));
  if (reason) {
    count(peer, *reason, time);
  } else if (peer.status.counters.forwarded == forwarded) {
    ++peer.status.counters.kept;
  }
}

Reason SwitchCore::take_frame(Peer& peer, const FrameView& frame, SwitchTime time) {
  ++peer.status.counters.frames;
  if (const Reason reason = refused_signature(peer, frame, time)) return reason;
  if (frame.info != nullptr) return take_known(peer, frame, time);
  // Its checksum could not be verified: nothing is learned from it.
  const Reason reason = router_.refused(peer.status.peer, frame.envelope(), time.now_s);
  return reason ? reason : forward(peer, frame, Arrival::New, time);
}

Reason SwitchCore::refused_signature(const Peer& peer, const FrameView& frame, SwitchTime time) {
  auto& checker = checkers_[peer.status.link];
  return checker ? refused_for(checker->check(frame, time.unix_s)) : std::nullopt;
}

Reason SwitchCore::take_known(Peer& peer, const FrameView& frame, SwitchTime time) {
  const auto learned = router_.learn(peer.status.peer, frame.envelope(), time.now_s);
  if (const auto* reason = std::get_if<Refused>(&learned)) return *reason;
  const Arrival arrival = std::get<Arrival>(learned);
  peer.status.last_heard_s = time.now_s;
  const Claimant from = claimant(peer, frame.envelope());
  switch (frame.message_id()) {
    case kSetupSigning:
      return Refused::NotForwarded;
    case kSetpoint:
      return take_setpoint(peer, frame, arrival, time);
    case kHeartbeat:
      if (from.priority > 0 && arrival == Arrival::New) desk_.heartbeat(from, time.now_s);
      break;
    case kCommandLong: {
      const FrameTarget target = target_of(frame);
      const Recipient& me = options_.self;
      if (target.system_id == me.system_id && target.component_id == me.component_id) {
        return take_control(peer, frame, arrival, time);
      }
      break;
    }
    default:
      break;
  }
  return forward(peer, frame, arrival, time);
}

Reason SwitchCore::take_setpoint(Peer& peer, const FrameView& frame, Arrival arrival,
                                 SwitchTime time) {
  const Claimant from = claimant(peer, frame.envelope());
  const auto setpoint = read<mavlink::SetPositionTarget>(frame);
  if (from.priority == 0 || !concerns(setpoint.target_system, options_.vehicle.system_id) ||
      !concerns(setpoint.target_component, options_.vehicle.component_id)) {
    return Refused::NotAllowed;
  }
  const Reason reason = desk_.setpoint(from, setpoint, arrival, time.now_s);
  if (!reason) {
    ++peer.status.counters.setpoints;
    ++peer.status.counters.forwarded;
  }
  send_due(time);
  return reason;
}

Reason SwitchCore::take_control(Peer& peer, const FrameView& frame, Arrival arrival,
                                SwitchTime time) {
  const auto command = read<mavlink::CommandLong>(frame);
  if (arrival == Arrival::Duplicate) return Refused::Duplicate;
  constexpr std::uint8_t kAccepted = 0, kDenied = 2, kUnsupported = 3;  // MAV_RESULT
  const bool known = is_switch_control(command.command);
  const bool allowed = known && link_of(peer).role == LinkRole::Ground;
  const auto what = SwitchControl(command.command);
  const bool done = allowed && desk_.control(what);
  send_due(time);
  if (allowed) {
    log_.add(time.now_s, peer.status.peer, done ? event_of(what) : SwitchEventKind::ControlDenied,
             "command " + std::to_string(command.command));
  }
  const Reason reason = allowed ? std::nullopt : Reason(Refused::NotAllowed);
  if (link_of(peer).role == LinkRole::Flight) return reason;  // it is told no more than it needs
  mavlink::CommandAck ack;
  ack.command = command.command;
  ack.result = done ? kAccepted : known ? kDenied : kUnsupported;
  ack.result_param2 = std::int32_t(bits_of(control()));
  ack.target_system = frame.envelope().system_id;
  ack.target_component = frame.envelope().component_id;
  outbox_.post(ack, next_envelope(), addressee(peer));
  ++peer.status.counters.delivered;
  return reason;
}

Reason SwitchCore::forward(Peer& peer, const FrameView& frame, Arrival arrival, SwitchTime time) {
  Reason refused;
  bool forwarded = false;
  for (const PeerId to : router_.destinations(peer.status.peer, frame, time.now_s)) {
    Peer& receiver = peers_.at(to);
    if (link_of(receiver).role == LinkRole::Flight) {
      refused = refused_to_flight(peer, frame, arrival);
      if (refused) continue;
    }
    outbox_.forward(frame, addressee(receiver));
    ++receiver.status.counters.delivered;
    forwarded = true;
  }
  // What flight control is not to hear anyway, such as words for the operator, is no offence.
  if (refused && target_of(frame).named) return refused;
  peer.status.counters.forwarded += forwarded ? 1 : 0;
  return std::nullopt;
}

Reason SwitchCore::refused_to_flight(const Peer& peer, const FrameView& frame,
                                     Arrival arrival) const {
  if (is_shut_) return Refused::Stopped;
  if (arrival == Arrival::Duplicate) return Refused::Duplicate;
  const Claimant from = claimant(peer, frame.envelope());
  return refused_for_flight(frame, {from.role, link_of(peer).may, desk_.arbiter().state(),
                                    desk_.arbiter().may_command(from.id, from.role)});
}

}  // namespace kestrel
