#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "kestrel/link/address.hpp"
#include "kestrel/link/bytes.hpp"

namespace kestrel {

/// What became of a datagram.
enum class Sent {
  Yes,           // the network has it; UDP tells no more
  AfterRefusal,  // the same, but nobody listened when an earlier one arrived
  No,            // no room, no route, no network
};

/// What arrived, and from where. The bytes are the socket's: good until it receives again.
struct Datagram {
  Bytes bytes;
  Address from;
};

/// A UDP socket, over IPv4 or IPv6 as its address says. Owns its descriptor. For one thread at a
/// time.
class UdpSocket {
 public:
  /// Hears what is sent to the address; port 0 takes any free one. Throws std::runtime_error when
  /// that cannot be, for instance because another program has the port.
  static UdpSocket bound_to(const Address& address);

  /// Sends to the address, and hears what it answers. Throws std::runtime_error when the address
  /// cannot be reached from here, std::invalid_argument for port 0 and for "any" address.
  static UdpSocket connected_to(const Address& address);

  UdpSocket(UdpSocket&& other) noexcept;
  UdpSocket& operator=(UdpSocket&& other) noexcept;
  UdpSocket(const UdpSocket&) = delete;
  UdpSocket& operator=(const UdpSocket&) = delete;
  ~UdpSocket();

  /// This end, with its real port.
  const Address& local() const { return local_; }

  /// Sends one datagram to the connected peer; never waits.
  Sent send(Bytes datagram) noexcept;

  /// The same to any address of the socket's family, from a socket that is not connected.
  Sent send_to(const Address& address, Bytes datagram) noexcept;

  /// The next datagram, waiting up to timeout_s for it (not at all when that is not positive).
  /// Empty after that time, when a signal came in between (so that the caller can look why), or
  /// when the peer refused an earlier datagram. Throws std::system_error when the socket is broken.
  std::optional<Datagram> receive(double timeout_s);

  /// The next datagram that is here already; empty when there is none or the network complains,
  /// which it does once for each complaint.
  std::optional<Datagram> take() noexcept;

  /// For who waits for several sockets at once.
  int descriptor() const { return descriptor_; }

 private:
  explicit UdpSocket(int descriptor);
  int descriptor_ = -1;
  Address local_;
  std::vector<std::uint8_t> buffer_;
};

}  // namespace kestrel
