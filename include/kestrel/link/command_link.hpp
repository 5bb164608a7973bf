#pragma once

#include <cstdint>

#include "kestrel/link/address.hpp"
#include "kestrel/link/frame.hpp"
#include "kestrel/link/setpoint.hpp"
#include "kestrel/link/socket.hpp"
#include "kestrel/vehicle/velocity_command.hpp"

namespace kestrel {

/// Who is commanded, and by whom: a companion computer is a component of its vehicle.
struct LinkOptions {
  Recipient to;
  std::uint8_t system_id = 1;
  std::uint8_t component_id = 191;  // MAV_COMP_ID_ONBOARD_COMPUTER

  /// Throws std::invalid_argument for a sender with id 0, which means everybody.
  void check() const;
};

struct LinkCounts {
  long commands = 0;    // calls of send
  long replaced = 0;    // of these, with a number that is not finite: hover was sent instead
  long failures = 0;    // of these, not sent, or sent after a datagram that nobody listened to
  long heartbeats = 0;  // tried
};

/// Sends each command as one MAVLink setpoint in a datagram of its own, and a heartbeat each second
/// by the stamps, from the same thread: a stuck loop falls silent. For one thread.
class CommandLink final : public CommandSink {
 public:
  /// Throws std::runtime_error or std::invalid_argument when nothing can be sent to the address.
  explicit CommandLink(const Address& to, const LinkOptions& options = {});

  /// A command or a stamp that is not finite becomes hover.
  void send(const VelocityCommand& command, double stamp_s) noexcept override;

  long failures() const override { return counts_.failures; }
  LinkCounts counts() const { return counts_; }

  /// This end.
  const Address& local() const { return socket_.local(); }

 private:
  Sent transmit(const mavlink::Message& message) noexcept;
  bool heartbeat_due(double stamp_s) noexcept;

  LinkOptions options_;
  UdpSocket socket_;
  std::uint8_t sequence_ = 0;
  double next_heartbeat_s_;
  LinkCounts counts_;
};

}  // namespace kestrel
