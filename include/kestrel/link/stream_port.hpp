#pragma once

#include <map>
#include <optional>

#include "kestrel/link/link_place.hpp"
#include "kestrel/link/poller.hpp"
#include "kestrel/link/port_event.hpp"
#include "kestrel/link/stream_socket.hpp"

namespace kestrel {

/// The TCP side of a link. A client connects, and after a loss again, with pauses that double; a
/// server accepts up to max_peers. Each connection is a peer of its own.
class StreamPort {
 public:
  StreamPort(const LinkPlace& place, const PortOptions& options, std::size_t number,
             Poller& poller);

  /// As LinkPort says.
  std::optional<PortEvent> next(std::uint64_t tag, double now_s) noexcept;
  std::optional<PortEvent> due(double now_s) noexcept;
  void send(PeerId peer, Bytes frame) noexcept;
  Address address() const;
  const PortCounts& counts() const { return counts_; }
  PeerTraffic traffic(PeerId peer) const;

 private:
  struct Peer {
    StreamSocket socket;
    double heard_s = 0;  // or, while connecting, since when
    bool awaits_room = false;
  };
  using Peers = std::map<PeerId, Peer>;
  std::optional<PortEvent> accept(double now_s);
  std::optional<PortEvent> progress(Peers::iterator peer, double now_s);
  std::optional<PortEvent> connected(Peers::iterator peer, double now_s);
  PortEvent end(Peers::iterator peer, double now_s);
  void connect(double now_s);
  void look_for_room(Peers::iterator peer) noexcept;
  std::uint64_t tag_of(PeerId peer) const { return tag_ | (peer & kPeerMask); }

  LinkPlace place_;
  PortOptions options_;
  PeerNumbers numbers_;
  std::uint64_t tag_;
  Poller* poller_;
  std::optional<StreamListener> listener_;
  Peers peers_;
  double pause_s_;
  double next_attempt_s_ = 0;
  PortCounts counts_;
};

}  // namespace kestrel
