#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "kestrel/link/link_place.hpp"
#include "kestrel/link/poller.hpp"
#include "kestrel/link/port_event.hpp"

namespace kestrel {

/// The sockets of one link, whatever its kind: the same calls for all. `number` is that of the
/// link; lower ones are served first.
class LinkPort {
 public:
  virtual ~LinkPort() = default;
  LinkPort(const LinkPort&) = delete;
  LinkPort& operator=(const LinkPort&) = delete;

  /// What comes next from the socket that is ready, told by its tag; empty when there is no more.
  virtual std::optional<PortEvent> next(std::uint64_t tag, double now_s) noexcept = 0;

  /// What comes about by time: the peer of a client, one that is silent; call until it is empty.
  virtual std::optional<PortEvent> due(double now_s) noexcept = 0;

  /// Sends one frame; an unknown peer is none of ours, and is passed over.
  virtual void send(PeerId peer, Bytes frame) noexcept = 0;

  /// Where it listens, with the real port; of a client where it connects to.
  virtual Address address() const = 0;

  /// What waits for a peer and what was dropped: of datagrams nothing waits.
  virtual PeerTraffic traffic(PeerId peer) const = 0;

  const PortCounts& counts() const { return counts_; }

 protected:
  /// Throws std::invalid_argument as PortOptions::check.
  LinkPort(const LinkPlace& place, const PortOptions& options, std::size_t number);

  LinkPlace place_;
  PortOptions options_;
  PeerNumbers numbers_;
  std::uint64_t tag_;
  PortCounts counts_;
};

/// Opens what must be open from the start. Throws std::runtime_error when it cannot listen there,
/// std::invalid_argument as PortOptions::check.
std::unique_ptr<LinkPort> open_link_port(const LinkPlace& place, const PortOptions& options,
                                         std::size_t number, Poller& poller);

}  // namespace kestrel
