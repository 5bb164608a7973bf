#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kestrel/link/frame.hpp"
#include "kestrel/vehicle/limits.hpp"

#include "link/relay_socket.hpp"
#include "support/random.hpp"

namespace kestrel::test {

/// Calls that are due at a rate, however seldom one asks.
class Rate {
 public:
  explicit Rate(double rate_hz) : period_s_(1 / rate_hz) {}
  /// How many are due now; after a pause of more than a second only those of one.
  int due(double now_s);

 private:
  double period_s_;
  double next_s_ = -1;
};

/// A vehicle that reports ten times as often as usual, and judges what it is told.
class SoakFlight {
 public:
  explicit SoakFlight(const CommandLimits& envelope);

  Address local() const { return local_address(socket_); }
  void turn(double now_s);

  long frames() const { return frames_; }
  long setpoints() const { return setpoints_; }
  long moves() const { return moves_; }
  /// Not finite, not a frame, over the envelope, or a descent, which only the hostile ask for.
  long wrong() const { return wrong_; }
  double longest_gap_s() const { return longest_gap_s_; }

 private:
  void judge(const std::vector<std::uint8_t>& datagram, double now_s);
  void send(const mavlink::Message& message);

  Descriptor socket_;
  std::optional<SystemAddress> switch_;
  VelocityCommand limit_;
  Rate attitude_{500};
  Rate heartbeat_{10};
  std::uint8_t sequence_ = 0;
  long frames_ = 0, setpoints_ = 0, moves_ = 0, wrong_ = 0;
  double last_setpoint_s_ = -1;
  double longest_gap_s_ = 0;
};

/// A companion or a script: setpoints and heartbeats over UDP.
class SoakSource {
 public:
  SoakSource(const Address& to, std::uint8_t component_id, const VelocityCommand& command,
             double rate_hz);
  void turn(double now_s);
  long sent() const { return sent_; }

 private:
  Descriptor socket_;
  std::uint8_t component_id_;
  VelocityCommand command_;
  Rate setpoints_;
  Rate heartbeats_{10};
  std::uint8_t sequence_ = 0;
  long sent_ = 0;
};

/// A ground station over TCP, which connects anew whenever it is cut off, and reads or does not.
class SoakGround {
 public:
  enum class Reads { All, Nothing };
  SoakGround(const Address& to, std::uint8_t system_id, Reads reads);
  void turn(double now_s);
  long connections() const { return connections_; }
  long read_bytes() const { return read_bytes_; }

 private:
  void connect();
  void send(const mavlink::Message& message);

  Address to_;
  std::uint8_t system_id_;
  Reads reads_;
  std::optional<Descriptor> socket_;
  double retry_s_ = 0;
  Rate heartbeats_{10};
  Rate requests_{20};
  std::uint8_t sequence_ = 0;
  long connections_ = 0;
  long read_bytes_ = 0;
};

/// One who sends anything but a good command, from ever new ports.
class SoakHostile {
 public:
  SoakHostile(const Address& to, std::string_view seed, double rate_hz);
  void turn(double now_s);
  long sent() const { return sent_; }

 private:
  std::vector<std::uint8_t> bad_input(double now_s);

  Address to_;
  Random random_;
  Rate rate_;
  std::optional<Descriptor> socket_;
  long sent_ = 0;
};

}  // namespace kestrel::test
