#pragma once

#include <vector>

#include "kestrel/link/address.hpp"
#include "kestrel/link/receiver_state.hpp"
#include "kestrel/link/setpoint.hpp"
#include "kestrel/link/socket.hpp"

namespace kestrel {

/// The stand-in for a flight controller: hears commands, obeys none. One thread polls and counts;
/// local() may be called from any. To stop, poll with a short time-out and look at a flag between.
class CommandReceiver {
 public:
  /// Throws std::runtime_error when it cannot listen there; port 0 takes any free one. `me` is the
  /// system and component that commands must be for.
  explicit CommandReceiver(const Address& at, const Recipient& me = {});

  /// The address with its real port.
  const Address& local() const { return socket_.local(); }

  /// The commands that have arrived, in their order: waits up to timeout_s for a datagram, then
  /// takes those that are there already, up to 256, so that a flood does not hold the caller.
  /// Empty after the time-out or a signal. Throws std::system_error when the socket is broken.
  std::vector<ReceivedCommand> poll(double timeout_s);

  const ReceiverCounts& counts() const { return state_.counts(); }

 private:
  UdpSocket socket_;
  ReceiverState state_;
};

}  // namespace kestrel
