#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>

#include "kestrel/link/datagram_port.hpp"
#include "kestrel/link/stream_port.hpp"

namespace kestrel {

/// The sockets of one link, whatever its kind: the same calls for all.
class LinkPort {
 public:
  /// Opens what must be open from the start. `number` is that of the link; lower ones are served
  /// first. Throws std::runtime_error when it cannot listen there, std::invalid_argument as
  /// PortOptions::check.
  LinkPort(const LinkPlace& place, const PortOptions& options, std::size_t number, Poller& poller);

  /// What comes next from the socket that is ready, told by its tag; empty when there is no more.
  std::optional<PortEvent> next(std::uint64_t tag, double now_s) noexcept;

  /// What comes about by time: the peer of a client, one that is silent; call until it is empty.
  std::optional<PortEvent> due(double now_s) noexcept;

  /// Sends one frame; an unknown peer is none of ours, and is passed over.
  void send(PeerId peer, Bytes frame) noexcept;

  /// Where it listens, with the real port; of a client where it connects to.
  Address address() const;
  PortCounts counts() const;
  /// What waits for a peer and what was dropped: of datagrams nothing waits.
  PeerTraffic traffic(PeerId peer) const;

 private:
  std::variant<DatagramPort, StreamPort> port_;
};

}  // namespace kestrel
