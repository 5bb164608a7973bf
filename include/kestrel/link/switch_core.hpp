#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "kestrel/link/address.hpp"
#include "kestrel/link/bytes.hpp"
#include "kestrel/link/switch_options.hpp"
#include "kestrel/link/switch_status.hpp"

namespace kestrel {

/// Control messages: COMMAND_LONG from a ground link to the switch's own system and component,
/// answered by COMMAND_ACK. MAV_CMD_USER_1 to MAV_CMD_USER_5 of MAVLink.
enum class SwitchControl : std::uint16_t {
  TakeOver = 31010,       // only ground sources may have control from now on
  Lock = 31011,           // the present owner keeps control
  Release = 31012,        // ends both; zero, then who speaks next may have control
  EmergencyStop = 31013,  // zeros, whatever anybody says
  Reset = 31014,          // ends the emergency stop; zero, then who speaks next
};

/// One moment, by two clocks.
struct SwitchTime {
  double now_s = 0;   // monotonic: every age and deadline
  double unix_s = 0;  // of the wall: signatures only
};

/// Bytes to be sent to a peer: one frame. They live until the next call.
struct Delivery {
  PeerId to = 0;
  Bytes bytes;
};

/// The switching layer without its sockets: what each peer says comes in, what each is to be told
/// goes out. Nothing in it blocks, throws in flight, reads a clock or grows without bound.
class SwitchCore {
 public:
  /// Throws std::invalid_argument as SwitchOptions::check.
  explicit SwitchCore(SwitchOptions options);

  /// A new peer behind a link (its index in the options). Beyond max_peers it is not heard.
  void connect(PeerId peer, std::size_t link, const Address& from, SwitchTime time);

  /// The peer is gone, and with it what was known of it.
  void disconnect(PeerId peer, SwitchTime time);

  /// What follows from a datagram, or a piece of a stream, of a peer: a setpoint that is obeyed
  /// goes to flight control at once.
  const std::vector<Delivery>& receive(PeerId peer, Bytes bytes, SwitchTime time);

  /// What is due: the setpoint to flight control at rate_hz, zeros at the deadman, heartbeats. May
  /// be called as often as wanted, at least at rate_hz.
  const std::vector<Delivery>& tick(SwitchTime time);

  /// A zero for flight control. From here on nothing else is sent to it.
  const std::vector<Delivery>& shutdown(SwitchTime time);

  SwitchStatus status(SwitchTime time) const;

  /// Events since the last call, oldest first; at most 1024 are kept.
  std::vector<SwitchEvent> take_events();

 private:
  SwitchOptions options_;
  std::map<PeerId, PeerStatus> peers_;
  std::vector<Delivery> deliveries_;
  std::vector<SwitchEvent> events_;
  std::uint64_t unknown_peer_chunks_ = 0;
};

}  // namespace kestrel
