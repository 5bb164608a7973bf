#pragma once

#include <cstddef>
#include <cstdint>

#include "kestrel/link/address.hpp"
#include "kestrel/link/bytes.hpp"
#include "kestrel/link/peer_counters.hpp"
#include "kestrel/link/stream_socket.hpp"

namespace kestrel {

/// Whom a port keeps.
struct PortOptions {
  std::size_t max_peers = 8;   // of a server; who is more has to wait
  double forget_s = 30;        // a sender of datagrams that is silent as long is gone
  double replace_s = 2;        // one that is silent as long makes room when there is none
  StreamOptions stream;        // of TCP
  double retry_s = 0.1;        // first pause of a client between attempts; doubled each time
  double longest_retry_s = 3;  // up to this

  /// Throws std::invalid_argument that names the option.
  void check() const;
};

/// What a link has to tell. Of one event: first the peer came, then it sent, then it went.
struct PortEvent {
  PeerId peer = 0;  // 0: something was there, but of no peer
  bool came = false;
  bool went = false;
  Address from;
  Bytes bytes;  // good until the port is asked again
};

/// What became of those who are not peers, and of what was sent.
struct PortCounts {
  std::uint64_t strangers = 0;    // datagrams of unknown senders that began with no intact frame
  std::uint64_t turned_away = 0;  // who came when there was no room
  std::uint64_t attempts = 0;     // to connect, of a client
  std::uint64_t dropped = 0;      // frames that the network did not take
};

/// What waits for one peer, and what did not reach it.
struct PeerTraffic {
  std::size_t queued = 0;
  std::uint64_t dropped = 0;
};

// Peers are numbered by their port and in the order of their coming.
constexpr int kPeerBits = 24;
constexpr std::uint32_t kPeerMask = (std::uint32_t(1) << kPeerBits) - 1;
constexpr std::size_t kMaxPorts = 255;

/// The port that gave a peer its number.
constexpr std::size_t port_of(PeerId peer) { return peer >> kPeerBits; }

/// Numbers for the peers of a port; none comes again before 16 million others have.
class PeerNumbers {
 public:
  explicit PeerNumbers(std::size_t port) : port_(PeerId(port) << kPeerBits) {}
  PeerId next() {
    count_ = count_ == kPeerMask ? 1 : count_ + 1;
    return port_ | count_;
  }

 private:
  PeerId port_;
  std::uint32_t count_ = 0;
};

}  // namespace kestrel
