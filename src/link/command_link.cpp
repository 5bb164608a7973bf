#include "kestrel/link/command_link.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace kestrel {
namespace {

constexpr double kHeartbeatPeriod_s = 1.0;

LinkOptions checked(const LinkOptions& options) {
  options.check();
  return options;
}

}  // namespace

void LinkOptions::check() const {
  if (system_id == 0) throw std::invalid_argument("system_id must be 1 to 255");
  if (component_id == 0) throw std::invalid_argument("component_id must be 1 to 255");
}

CommandLink::CommandLink(const Address& to, const LinkOptions& options)
    : options_(checked(options)),
      socket_(UdpSocket::connected_to(to)),
      next_heartbeat_s_(-std::numeric_limits<double>::infinity()) {}

void CommandLink::send(const VelocityCommand& command, double stamp_s) noexcept {
  const bool sendable = is_sendable(command) && std::isfinite(stamp_s);
  const Sent setpoint = transmit(velocity_setpoint(sendable ? command : VelocityCommand::hover(),
                                                   time_boot_ms(stamp_s), options_.to));
  Sent heartbeat = Sent::Yes;
  if (heartbeat_due(stamp_s)) {
    heartbeat = transmit(mavlink::Heartbeat{});
    ++counts_.heartbeats;
  }
  ++counts_.commands;
  if (!sendable) ++counts_.replaced;
  if (setpoint != Sent::Yes || heartbeat != Sent::Yes) ++counts_.failures;
}

Sent CommandLink::transmit(const mavlink::Message& message) noexcept {
  // A frame that is not sent keeps its number: the receiver is to see the gap.
  return socket_.send(
      mavlink::encode(message, {options_.system_id, options_.component_id, sequence_++}).bytes());
}

bool CommandLink::heartbeat_due(double stamp_s) noexcept {
  // Once a second on the average; after a jump of the stamps, either way, it starts anew.
  const double late_s = stamp_s - next_heartbeat_s_;
  if (!std::isfinite(stamp_s)) return false;
  if (late_s < 0 && late_s >= -kHeartbeatPeriod_s) return false;
  next_heartbeat_s_ = late_s >= 0 && late_s < kHeartbeatPeriod_s
                          ? next_heartbeat_s_ + kHeartbeatPeriod_s
                          : stamp_s + kHeartbeatPeriod_s;
  return true;
}

}  // namespace kestrel
