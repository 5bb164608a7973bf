#pragma once

#include <optional>
#include <vector>

#include "kestrel/link/link_port.hpp"
#include "kestrel/link/socket.hpp"

namespace kestrel {

/// The UDP side of a link. Of a client the one peer is where it sends to, from the first due() on.
/// Of a server a peer is a sender whose datagram began with an intact frame of a known message,
/// until it is silent for forget_s; noise from forged addresses takes nobody's place.
class DatagramPort final : public LinkPort {
 public:
  DatagramPort(const LinkPlace& place, const PortOptions& options, std::size_t number,
               Poller& poller);

  std::optional<PortEvent> next(std::uint64_t tag, double now_s) noexcept override;
  std::optional<PortEvent> due(double now_s) noexcept override;
  void send(PeerId peer, Bytes frame) noexcept override;
  Address address() const override;
  PeerTraffic traffic(PeerId peer) const override;

 private:
  struct Peer {
    PeerId id = 0;
    Address at;
    double heard_s = 0;
    std::uint64_t dropped = 0;
  };
  PortEvent told(const Datagram& datagram, double now_s);
  PortEvent stranger(const Datagram& datagram, double now_s);
  std::optional<PortEvent> silent_for(double limit_s, double now_s);

  UdpSocket socket_;
  std::vector<Peer> peers_;
};

}  // namespace kestrel
