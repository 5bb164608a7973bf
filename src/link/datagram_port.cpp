#include "kestrel/link/datagram_port.hpp"

#include <algorithm>
#include <variant>

namespace kestrel {
namespace {

UdpSocket opened(const LinkPlace& place) {
  return is_server(place.kind) ? UdpSocket::bound_to(place.address)
                               : UdpSocket::connected_to(place.address);
}

bool begins_with_a_known_frame(Bytes datagram) {
  const mavlink::Parsed parsed = mavlink::parse(datagram);
  const auto* frame = std::get_if<mavlink::FrameView>(&parsed.content);
  return frame != nullptr && frame->info != nullptr;
}

}  // namespace

DatagramPort::DatagramPort(const LinkPlace& place, const PortOptions& options, std::size_t number,
                           Poller& poller)
    : LinkPort(place, options, number), socket_(opened(place)) {
  poller.watch(socket_.descriptor(), tag_);
}

std::optional<PortEvent> DatagramPort::next(std::uint64_t, double now_s) noexcept {
  const std::optional<Datagram> datagram = socket_.take();
  if (!datagram) return std::nullopt;
  return told(*datagram, now_s);
}

PortEvent DatagramPort::told(const Datagram& datagram, double now_s) {
  for (Peer& peer : peers_) {
    if (peer.at != datagram.from) continue;
    peer.heard_s = now_s;
    return PortEvent{peer.id, false, false, datagram.from, datagram.bytes};
  }
  return is_server(place_.kind) ? stranger(datagram, now_s) : PortEvent{};
}

PortEvent DatagramPort::stranger(const Datagram& datagram, double now_s) {
  if (!begins_with_a_known_frame(datagram.bytes)) {
    ++counts_.strangers;
    return {};
  }
  if (peers_.size() >= options_.max_peers) {
    ++counts_.turned_away;
    // The next datagram of this one finds the room.
    return silent_for(options_.replace_s, now_s).value_or(PortEvent{});
  }
  peers_.push_back({numbers_.next(), datagram.from, now_s, 0});
  return PortEvent{peers_.back().id, true, false, datagram.from, datagram.bytes};
}

/// The peer that is silent for longest is gone, if that is at least this long.
std::optional<PortEvent> DatagramPort::silent_for(double limit_s, double now_s) {
  const auto silent =
      std::min_element(peers_.begin(), peers_.end(),
                       [](const Peer& a, const Peer& b) { return a.heard_s < b.heard_s; });
  if (silent == peers_.end() || now_s - silent->heard_s < limit_s) return std::nullopt;
  const PortEvent event{silent->id, false, true, silent->at, {}};
  peers_.erase(silent);
  return event;
}

std::optional<PortEvent> DatagramPort::due(double now_s) noexcept {
  if (is_server(place_.kind)) return silent_for(options_.forget_s, now_s);
  if (!peers_.empty()) return std::nullopt;
  peers_.push_back({numbers_.next(), place_.address, now_s, 0});
  return PortEvent{peers_.back().id, true, false, place_.address, {}};
}

void DatagramPort::send(PeerId id, Bytes frame) noexcept {
  const auto peer =
      std::find_if(peers_.begin(), peers_.end(), [id](const Peer& one) { return one.id == id; });
  if (peer == peers_.end()) return;
  const Sent sent = is_server(place_.kind) ? socket_.send_to(peer->at, frame) : socket_.send(frame);
  if (sent != Sent::No) return;
  ++peer->dropped;
  ++counts_.dropped;
}

Address DatagramPort::address() const {
  return is_server(place_.kind) ? socket_.local() : place_.address;
}

PeerTraffic DatagramPort::traffic(PeerId id) const {
  for (const Peer& peer : peers_) {
    if (peer.id == id) return {0, peer.dropped};
  }
  return {};
}

}  // namespace kestrel
