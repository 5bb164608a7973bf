#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "kestrel/link/frame.hpp"
#include "kestrel/link/link_place.hpp"
#include "kestrel/link/setpoint.hpp"
#include "kestrel/link/socket.hpp"
#include "kestrel/link/stream_socket.hpp"

// The other ends of a switch, in the test's own process.
namespace kestrel::test {

/// Longer than a loaded machine needs: only a test that fails waits for it.
constexpr double kLong_s = 20;

inline double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// True as soon as the condition is, which is asked each 10 ms.
template <class Condition>
bool comes(const Condition& condition, double within_s = kLong_s) {
  for (const double end_s = now_s() + within_s; now_s() < end_s;) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

/// Sends over UDP or over TCP as one component.
class Speaker {
 public:
  Speaker(const LinkPlace& place, std::uint8_t system_id, std::uint8_t component_id)
      : system_id_(system_id), component_id_(component_id) {
    if (is_stream(place.kind)) {
      stream_ = StreamSocket::connecting_to(place.address);
    } else {
      socket_ = UdpSocket::connected_to(place.address);
    }
  }

  void say(const mavlink::Message& message) {
    const auto frame = mavlink::encode(message, {system_id_, component_id_, sequence_++});
    if (socket_) socket_->send(frame.bytes());
    if (!stream_) return;
    stream_->finish_connecting();
    stream_->send(frame.bytes());
  }

  void beat() { say(mavlink::Heartbeat{}); }

  /// What a companion computer says with each frame of its camera.
  void ask_forward(double forward_m_s) {
    beat();
    VelocityCommand command;
    command.forward_m_s = forward_m_s;
    say(velocity_setpoint(command, time_boot_ms(now_s()), {}));
  }

  /// A control message to the switch itself (1, 192).
  void command(std::uint16_t number) {
    mavlink::CommandLong message;
    message.command = number;
    message.target_system = 1;
    message.target_component = 192;
    beat();
    say(message);
  }

  /// True when a message of this kind has come meanwhile (of those over UDP).
  template <class Message>
  bool hears() {
    while (const std::optional<Datagram> datagram = socket_->take()) {
      const mavlink::Decoded decoded = mavlink::decode(datagram->bytes);
      const auto* packet = std::get_if<mavlink::Packet>(&decoded.content);
      if (packet != nullptr && std::holds_alternative<Message>(packet->message)) return true;
    }
    return false;
  }

 private:
  std::uint8_t system_id_;
  std::uint8_t component_id_;
  std::uint8_t sequence_ = 0;
  std::optional<UdpSocket> socket_;
  std::optional<StreamSocket> stream_;
};

/// Flight control: what it was asked for last.
class Autopilot {
 public:
  explicit Autopilot(const Address& at) : socket_(UdpSocket::bound_to(at)) {}

  const Address& address() const { return socket_.local(); }

  /// Reads all that has arrived; the last velocity forward, empty when none arrived at all.
  std::optional<double> asked() {
    while (const std::optional<Datagram> datagram = socket_.take()) {
      from_ = datagram->from;
      const mavlink::Decoded decoded = mavlink::decode(datagram->bytes);
      const auto* packet = std::get_if<mavlink::Packet>(&decoded.content);
      if (packet == nullptr) continue;
      if (const auto* setpoint = std::get_if<mavlink::SetPositionTarget>(&packet->message)) {
        forward_m_s_ = double(setpoint->vx_m_s);
        ++setpoints_;
      }
    }
    return forward_m_s_;
  }

  /// Something for all who listen.
  void say(const mavlink::Message& message) {
    if (from_) socket_.send_to(*from_, mavlink::encode(message, {1, 1, sequence_++}).bytes());
  }

  long setpoints() const { return setpoints_; }

 private:
  UdpSocket socket_;
  std::optional<Address> from_;
  std::optional<double> forward_m_s_;
  std::uint8_t sequence_ = 0;
  long setpoints_ = 0;
};

}  // namespace kestrel::test
