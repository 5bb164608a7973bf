#include "kestrel/link/stream_port.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace kestrel {
namespace {

using State = StreamSocket::State;

// Connecting that takes longer is given up: the other end is not there.
constexpr double kLongestConnecting_s = 3;

}  // namespace

StreamPort::StreamPort(const LinkPlace& place, const PortOptions& options, std::size_t number,
                       Poller& poller)
    : LinkPort(place, options, number), poller_(&poller), pause_s_(options.retry_s) {
  if (!is_server(place.kind)) return;
  listener_ = StreamListener::bound_to(place.address);
  poller.watch(listener_->descriptor(), tag_);
}

std::optional<PortEvent> StreamPort::next(std::uint64_t tag, double now_s) noexcept {
  if (tag == tag_) return accept(now_s);
  const auto low = std::uint32_t(tag & kPeerMask);
  const auto peer = std::find_if(peers_.begin(), peers_.end(),
                                 [low](const auto& one) { return (one.first & kPeerMask) == low; });
  return peer == peers_.end() ? std::nullopt : progress(peer, now_s);
}

std::optional<PortEvent> StreamPort::accept(double now_s) {
  std::optional<StreamSocket> socket = listener_->accept(options_.stream);
  if (!socket) return std::nullopt;
  if (peers_.size() >= options_.max_peers) {  // closed at once: the other end knows
    ++counts_.turned_away;
    const auto silent = std::min_element(
        peers_.begin(), peers_.end(),
        [](const auto& a, const auto& b) { return a.second.heard_s < b.second.heard_s; });
    if (now_s - silent->second.heard_s < options_.replace_s) return PortEvent{};
    return end(silent, now_s);
  }
  const PeerId id = numbers_.next();
  const Address from = socket->peer();
  poller_->watch(socket->descriptor(), tag_of(id));
  peers_.emplace(id, Peer{std::move(*socket), now_s});
  return PortEvent{id, true, false, from, {}};
}

std::optional<PortEvent> StreamPort::progress(Peers::iterator peer, double now_s) {
  StreamSocket& socket = peer->second.socket;
  if (socket.state() == State::Connecting) return connected(peer, now_s);
  socket.flush();
  const Bytes bytes = socket.receive();
  if (bytes.size > 0) {
    peer->second.heard_s = now_s;
    pause_s_ = options_.retry_s;  // somebody speaks there
    return PortEvent{peer->first, false, false, socket.peer(), bytes};
  }
  if (socket.state() == State::Closed) return end(peer, now_s);
  look_for_room(peer);
  return std::nullopt;
}

/// Nothing is told of a connection that never was open.
std::optional<PortEvent> StreamPort::connected(Peers::iterator peer, double now_s) {
  StreamSocket& socket = peer->second.socket;
  const State state = socket.finish_connecting();
  if (state == State::Connecting) return std::nullopt;
  if (state == State::Closed) {
    end(peer, now_s);
    return PortEvent{};
  }
  peer->second.heard_s = now_s;
  poller_->watch(socket.descriptor(), tag_of(peer->first));
  return PortEvent{peer->first, true, false, socket.peer(), {}};
}

PortEvent StreamPort::end(Peers::iterator peer, double now_s) {
  PortEvent event{peer->first, false, true, peer->second.socket.peer(), {}};
  counts_.dropped += std::uint64_t(peer->second.socket.queue().dropped());
  counts_.dropped += peer->second.socket.queue().size();
  peers_.erase(peer);
  next_attempt_s_ = now_s + pause_s_;
  pause_s_ = std::min(2 * pause_s_, options_.longest_retry_s);
  return event;
}

std::optional<PortEvent> StreamPort::due(double now_s) noexcept {
  if (is_server(place_.kind)) return std::nullopt;
  if (peers_.empty()) {
    if (now_s >= next_attempt_s_) connect(now_s);
    return std::nullopt;
  }
  const auto peer = peers_.begin();
  const bool connecting = peer->second.socket.state() == State::Connecting;
  if (connecting && now_s - peer->second.heard_s > kLongestConnecting_s) end(peer, now_s);
  return std::nullopt;
}

void StreamPort::connect(double now_s) {
  ++counts_.attempts;
  try {
    StreamSocket socket = StreamSocket::connecting_to(place_.address, options_.stream);
    const PeerId id = numbers_.next();
    poller_->watch(socket.descriptor(), tag_of(id), Poller::Interest::ReadAndWrite);
    peers_.emplace(id, Peer{std::move(socket), now_s});
  } catch (const std::runtime_error&) {  // no route now: perhaps later
    next_attempt_s_ = now_s + pause_s_;
    pause_s_ = std::min(2 * pause_s_, options_.longest_retry_s);
  }
}

void StreamPort::send(PeerId id, Bytes frame) noexcept {
  const auto peer = peers_.find(id);
  if (peer == peers_.end()) return;
  peer->second.socket.send(frame);
  look_for_room(peer);
}

/// Waits for room to write while something waits to be written, and only then.
void StreamPort::look_for_room(Peers::iterator peer) noexcept {
  const bool waits = !peer->second.socket.queue().empty();
  if (waits == peer->second.awaits_room) return;
  peer->second.awaits_room = waits;
  poller_->watch(peer->second.socket.descriptor(), tag_of(peer->first),
                 waits ? Poller::Interest::ReadAndWrite : Poller::Interest::Read);
}

Address StreamPort::address() const { return listener_ ? listener_->local() : place_.address; }

PeerTraffic StreamPort::traffic(PeerId id) const {
  const auto peer = peers_.find(id);
  if (peer == peers_.end()) return {};
  const SendQueue& queue = peer->second.socket.queue();
  return {queue.size(), std::uint64_t(queue.dropped())};
}

}  // namespace kestrel
