#pragma once

#include <map>
#include <set>
#include <vector>

#include "kestrel/link/frame.hpp"
#include "kestrel/link/switch_core.hpp"

#include "link/samples.hpp"

namespace kestrel::test {

/// Five links: autopilot, companion, ground station, script, listener, in this order.
SwitchOptions bench_switch();

/// The switch without sockets, one peer behind each link, and a clock that stands until time
/// passes. All that is given out is kept.
class SwitchBench {
 public:
  static constexpr PeerId kFlight = 1;
  static constexpr PeerId kVision = 2;
  static constexpr PeerId kGround = 3;
  static constexpr PeerId kScript = 4;
  static constexpr PeerId kListener = 5;
  static constexpr double kStep_s = 0.005;  // between two ticks

  /// Connects all, and lets all but the listener beat.
  explicit SwitchBench(const SwitchOptions& options = bench_switch());

  /// One frame given out.
  struct Heard {
    double time_s = 0;
    Buffer bytes;

    /// Empty for an unknown message.
    std::optional<mavlink::Packet> packet() const;
  };
  /// A setpoint given to flight control.
  struct Flown {
    double time_s = 0;
    mavlink::SetPositionTarget setpoint;

    Eigen::Vector4d velocity() const;
    bool is_zero() const { return velocity().isZero(0); }
  };

  double now_s() const { return now_s_; }
  SwitchCore& core() { return core_; }
  SwitchTime time() const { return {now_s_, kUnix_s + now_s_}; }

  /// Bytes of a peer arrive now.
  void say(PeerId peer, Bytes bytes);
  void say(PeerId peer, const Buffer& bytes) { say(peer, view(bytes)); }
  /// A message in the peer's own name, with its next number.
  void say(PeerId peer, const mavlink::Message& message) { say(peer, frame(peer, message)); }
  Buffer frame(PeerId peer, const mavlink::Message& message);
  mavlink::Envelope next_envelope(PeerId peer);

  /// A setpoint of the peer for a frame captured age_s ago.
  void command(PeerId peer, const VelocityCommand& command, double age_s = 0);
  /// A control message to the switch itself.
  void control(PeerId peer, SwitchControl what);

  /// Time passes, with ticks and heartbeats.
  void pass(double duration_s);
  /// The same, and the peer commands at 20 Hz.
  void fly(PeerId peer, const VelocityCommand& velocity, double duration_s);

  void mute(PeerId peer) { beating_.erase(peer); }
  void disconnect(PeerId peer);
  void connect(PeerId peer, std::size_t link);

  const std::vector<Heard>& heard(PeerId peer) { return heard_[peer]; }
  std::vector<Flown> flown() { return flown_since(-1); }
  std::vector<Flown> flown_since(double time_s);
  /// The newest setpoint to flight control; there must be one.
  Flown last_flown();
  std::uint64_t refused(PeerId peer, Refused reason) const;
  PeerCounters counters(PeerId peer) const;
  ControlState state() const { return core_.status(time()).control; }
  std::optional<SourceId> owner() const { return core_.status(time()).owner; }
  std::vector<SwitchEvent> events(SwitchEventKind kind);

 private:
  static constexpr double kUnix_s = 1.8e9;

  void keep(const std::vector<Delivery>& deliveries);

  SwitchCore core_;
  double now_s_ = 100;
  std::map<PeerId, std::uint8_t> sequence_;
  std::set<PeerId> beating_;
  double next_beat_s_ = 100;
  std::map<PeerId, std::vector<Heard>> heard_;
  std::vector<SwitchEvent> events_;
};

}  // namespace kestrel::test
