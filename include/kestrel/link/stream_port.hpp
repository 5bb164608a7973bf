#pragma once

#include <map>
#include <optional>

#include "kestrel/link/link_port.hpp"
#include "kestrel/link/stream_socket.hpp"

namespace kestrel {

/// The TCP side of a link. A client connects, and after a loss again, with pauses that double; a
/// server accepts up to max_peers. Each connection is a peer of its own.
class StreamPort final : public LinkPort {
 public:
  StreamPort(const LinkPlace& place, const PortOptions& options, std::size_t number,
             Poller& poller);

  std::optional<PortEvent> next(std::uint64_t tag, double now_s) noexcept override;
  std::optional<PortEvent> due(double now_s) noexcept override;
  void send(PeerId peer, Bytes frame) noexcept override;
  Address address() const override;
  PeerTraffic traffic(PeerId peer) const override;

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

  Poller* poller_;
  std::optional<StreamListener> listener_;
  Peers peers_;
  double pause_s_;
  double next_attempt_s_ = 0;
};

}  // namespace kestrel
