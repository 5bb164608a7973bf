#include "kestrel/link/switch_core.hpp"

#include <utility>

namespace kestrel {

SwitchCore::SwitchCore(SwitchOptions options) : options_(std::move(options)) { options_.check(); }

void SwitchCore::connect(PeerId peer, std::size_t link, const Address& from, SwitchTime time) {
  if (link >= options_.links.size()) return;
  if (peers_.size() >= options_.max_peers) {
    events_.push_back({time.now_s, peer, SwitchEventKind::TooManyPeers, to_string(from)});
    return;
  }
  peers_[peer] = {peer, link, from, time.now_s, {}, {}};
  events_.push_back({time.now_s, peer, SwitchEventKind::Connected, to_string(from)});
}

void SwitchCore::disconnect(PeerId peer, SwitchTime time) {
  if (peers_.erase(peer) == 0) return;
  events_.push_back({time.now_s, peer, SwitchEventKind::Disconnected, {}});
}

const std::vector<Delivery>& SwitchCore::receive(PeerId peer, Bytes bytes, SwitchTime) {
  deliveries_.clear();
  const auto found = peers_.find(peer);
  if (found == peers_.end()) {
    ++unknown_peer_chunks_;
    return deliveries_;
  }
  ++found->second.counters.chunks;
  found->second.counters.bytes += bytes.size;
  return deliveries_;
}

const std::vector<Delivery>& SwitchCore::tick(SwitchTime) {
  deliveries_.clear();
  return deliveries_;
}

const std::vector<Delivery>& SwitchCore::shutdown(SwitchTime time) {
  deliveries_.clear();
  events_.push_back({time.now_s, 0, SwitchEventKind::Shutdown, {}});
  return deliveries_;
}

SwitchStatus SwitchCore::status(SwitchTime time) const {
  SwitchStatus status;
  status.now_s = time.now_s;
  status.unknown_peer_chunks = unknown_peer_chunks_;
  for (const auto& [id, peer] : peers_) status.peers.push_back(peer);
  return status;
}

std::vector<SwitchEvent> SwitchCore::take_events() { return std::exchange(events_, {}); }

}  // namespace kestrel
