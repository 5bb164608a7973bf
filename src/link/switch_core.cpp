#include "kestrel/link/switch_core.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "kestrel/link/setpoint.hpp"

namespace kestrel {
namespace {

SwitchOptions checked(SwitchOptions options) {
  options.check();
  return options;
}

double dead_after_s(const SwitchOptions& options) {
  return options.heartbeat_period_s * options.missed_heartbeats;
}

CommandDeskOptions desk_options(const SwitchOptions& options) {
  return {options.envelope, 1 / options.rate_hz, options.deadman_s, options.time_to_live_s,
          dead_after_s(options)};
}

RouterOptions router_options(const SwitchOptions& options) {
  RouterOptions made{options.vehicle, options.self, dead_after_s(options), 0};
  made.expiry_s = 6 * made.live_s;
  return made;
}

std::string words(const std::optional<SourceId>& owner) {
  if (!owner) return "nobody";
  return "system " + std::to_string(owner->system_id) + " component " +
         std::to_string(owner->component_id) + " of peer " + std::to_string(owner->peer);
}

}  // namespace

SwitchCore::SwitchCore(SwitchOptions options)
    : options_(checked(std::move(options))),
      router_(router_options(options_)),
      desk_(desk_options(options_)),
      outbox_(options_.signing_times),
      departed_(options_.links.size()) {
  for (const SwitchLink& link : options_.links) {
    auto& checker = checkers_.emplace_back();
    if (link.key) checker.emplace(*link.key, options_.signing_floor);
  }
}

void SwitchCore::connect(PeerId id, std::size_t link, const Address& from, SwitchTime time) {
  if (link >= options_.links.size() || peers_.count(id) > 0) return;
  const auto of_link = std::count_if(peers_.begin(), peers_.end(), [&](const auto& each) {
    return each.second.status.link == link;
  });
  const std::string where = options_.links[link].name + " " + to_string(from);
  if (std::size_t(of_link) >= options_.max_peers) {
    log_.add(time.now_s, id, SwitchEventKind::TooManyPeers, where);
    return;
  }
  Peer peer{{id, link, from, time.now_s, {}, {}}, TokenBucket(options_.links[link].flow), nullptr};
  if (options_.links[link].transport == Transport::Stream) {
    peer.stream = std::make_unique<mavlink::StreamParser>();
  }
  if (of_link == 0 && options_.links[link].role == LinkRole::Flight) {
    desk_.start_from_rest(time.now_s);
  }
  peers_.emplace(id, std::move(peer));
  router_.connect(id, options_.links[link].role);
  log_.add(time.now_s, id, SwitchEventKind::Connected, where);
}

void SwitchCore::disconnect(PeerId id, SwitchTime time) {
  const auto found = peers_.find(id);
  if (found == peers_.end()) return;
  PeerCounters& departed = departed_[found->second.status.link];
  departed = departed + found->second.status.counters;
  peers_.erase(found);
  router_.disconnect(id);
  desk_.forget(id, time.now_s);
  log_.add(time.now_s, id, SwitchEventKind::Disconnected, {});
}

Claimant SwitchCore::claimant(const Peer& peer, const mavlink::Envelope& envelope) const {
  const SwitchLink& link = link_of(peer);
  return {{peer.status.peer, envelope.system_id, envelope.component_id},
          link.role,
          link.priority > 0 ? link.priority : default_priority(link.role)};
}

Addressee SwitchCore::addressee(const Peer& peer) const {
  const SwitchLink& link = link_of(peer);
  return {peer.status.peer, std::uint8_t(peer.status.link), link.key ? &*link.key : nullptr};
}

const std::vector<Delivery>& SwitchCore::tick(SwitchTime time) {
  outbox_.start(time.unix_s);
  send_due(time);
  send_heartbeats(time);
  for (const SourceId& dead : desk_.take_dead()) {
    log_.add(time.now_s, dead.peer, SwitchEventKind::SourceDead, words(dead));
  }
  return outbox_.deliveries();
}

const std::vector<Delivery>& SwitchCore::shutdown(SwitchTime time) {
  outbox_.start(time.unix_s);
  is_shut_ = true;
  desk_.close();
  send_due(time);
  log_.add(time.now_s, 0, SwitchEventKind::Shutdown, {});
  return outbox_.deliveries();
}

void SwitchCore::send_due(SwitchTime time) {
  const auto setpoint = desk_.due(time.now_s);
  note_changes(time);
  if (!setpoint) return;
  const mavlink::Message message =
      velocity_setpoint(setpoint->command, time_boot_ms(setpoint->captured_s), options_.vehicle);
  mavlink::Envelope envelope{options_.self.system_id, options_.self.component_id, 0};
  const auto owner = desk_.arbiter().owner();
  if (options_.setpoint_ids == SetpointIds::Owner && owner) {
    envelope = {owner->system_id, owner->component_id, owner_sequence_++};
  } else {
    envelope = next_envelope();
  }
  for (auto& [id, peer] : peers_) {
    if (link_of(peer).role != LinkRole::Flight) continue;
    outbox_.post(message, envelope, addressee(peer));
    ++peer.status.counters.delivered;
  }
}

ControlWord SwitchCore::control() const {
  ControlWord word{desk_.arbiter().state(), std::nullopt};
  const auto owner = desk_.arbiter().owner();
  const auto peer = owner ? peers_.find(owner->peer) : peers_.end();
  if (peer != peers_.end()) word.owner = link_of(peer->second).role;
  return word;
}

void SwitchCore::send_heartbeats(SwitchTime time) {
  if (time.now_s < next_heartbeat_s_) return;
  next_heartbeat_s_ = time.now_s + options_.heartbeat_period_s;
  constexpr std::uint8_t kActive = 4, kEmergency = 6;  // MAV_STATE
  mavlink::Heartbeat heartbeat;
  const ControlState state = desk_.arbiter().state();
  heartbeat.custom_mode = bits_of(control());
  heartbeat.system_status = state == ControlState::Stopped ? kEmergency : kActive;
  const mavlink::Envelope envelope = next_envelope();
  for (auto& [id, peer] : peers_) {
    if (is_shut_ && link_of(peer).role == LinkRole::Flight) continue;
    outbox_.post(heartbeat, envelope, addressee(peer));
    ++peer.status.counters.delivered;
  }
}

void SwitchCore::note_changes(SwitchTime time) {
  if (desk_.deadman_count() != deadman_count_) {
    deadman_count_ = desk_.deadman_count();
    log_.add(time.now_s, owner_ ? owner_->peer : 0, SwitchEventKind::Deadman, words(owner_));
  }
  const auto owner = desk_.arbiter().owner();
  if (owner == owner_) return;
  log_.add(time.now_s, owner ? owner->peer : 0, SwitchEventKind::OwnerChanged,
           "from " + words(owner_) + " to " + words(owner));
  owner_ = owner;
}

SwitchStatus SwitchCore::status(SwitchTime time) const {
  SwitchStatus status;
  status.now_s = time.now_s;
  status.control = desk_.arbiter().state();
  status.owner = desk_.arbiter().owner();
  status.sent = desk_.stream().sent();
  status.setpoints_sent = desk_.stream().sent_count();
  status.zeros_sent = desk_.stream().zero_count();
  status.newest_signature = options_.signing_floor;
  for (const auto& checker : checkers_) {
    if (checker) status.newest_signature = std::max(status.newest_signature, checker->newest());
  }
  status.events_dropped = log_.dropped();
  status.unknown_peer_chunks = unknown_peer_chunks_;
  for (const auto& [id, peer] : peers_) status.peers.push_back(peer.status);
  status.departed = departed_;
  return status;
}

}  // namespace kestrel
