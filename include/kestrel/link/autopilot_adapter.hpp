#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "kestrel/link/clock_sync.hpp"
#include "kestrel/link/frame.hpp"
#include "kestrel/link/handshake.hpp"
#include "kestrel/link/setpoint_stream.hpp"
#include "kestrel/link/telemetry.hpp"

namespace kestrel {

/// What the adapter is there for.
enum class AdapterPart {
  Pilot,     // decides and flies
  Observer,  // listens: asks for telemetry and the time, never sends a setpoint, a mode or a
             // landing
};

struct AutopilotOptions {
  AdapterPart part = AdapterPart::Pilot;
  double rate_hz = 20;       // of the setpoints, whatever the frame rate; 10 to 50
  double attitude_hz = 50;   // asked of the vehicle
  double position_hz = 10;   // asked of the vehicle
  double alive_s = 1;        // without a new frame for so long there is no heartbeat
  double farewell_s = 0.5;   // zeros for so long before control is given back
  std::uint8_t vehicle = 0;  // system id of the vehicle; 0: the first autopilot that is heard
  std::uint8_t component_id = 191;  // ours: MAV_COMP_ID_ONBOARD_COMPUTER
  SetpointStreamOptions stream;
  HandshakeOptions handshake;
  ClockSyncOptions clock;
  TelemetryOptions telemetry;

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

struct AdapterCounts {
  long setpoints = 0;   // sent
  long zeros = 0;       // of these, exact zeros
  long heartbeats = 0;  // sent
  long commands = 0;    // sent: modes, arming, intervals
  long received = 0;    // frames of the vehicle
  long foreign = 0;     // intact frames of others
  long malformed = 0;   // stretches of bytes that were no frame
};

/// Where the adapter stands, for a human and for a log.
struct AdapterStatus {
  HandshakeState control = HandshakeState::Unseen;
  std::string words;  // why
  std::optional<Autopilot> autopilot;
  std::optional<VehicleState> vehicle;
  StreamState stream = StreamState::Waiting;
  std::optional<ClockEstimate> clock;
  long clock_jumps = 0;
  AdapterCounts counts;
  StreamCounts decided;
  TelemetryCounts telemetry;
};

/// All that stands between the commands decided and an autopilot, without a socket, a thread or a
/// clock: stream, handshake, clock, telemetry, heartbeats. Times are of one monotonic clock; the
/// setpoints carry it as time_boot_ms, and questions of TIMESYNC are answered by it.
class AutopilotAdapter {
 public:
  using Frames = std::vector<mavlink::EncodedFrame>;

  /// Throws as AutopilotOptions::check.
  explicit AutopilotAdapter(const AutopilotOptions& options = {});

  /// The command for the frame captured at capture_s. With take_control the first one asks for
  /// control; a later one never does.
  void decide(const VelocityCommand& command, double capture_s, double now_s);

  /// What is answered at once to a datagram.
  Frames receive(Bytes datagram, double now_s);

  /// What is due: at least rate_hz times a second.
  Frames tick(double now_s);

  /// The setpoint among what the last tick gave, if there was one.
  const std::optional<StreamSetpoint>& ticked_setpoint() const { return ticked_; }

  /// A human asks for control, or for the ground.
  void request_control() { handshake_.request_control(); }
  void request_landing() { handshake_.request_landing(); }

  /// Zeros, then control is given back. From here on decisions are not listened to.
  void release(double now_s);

  /// True when that is done.
  bool released() const;

  std::optional<Attitude> attitude_at(double stamp_s) const {
    return telemetry_.attitude_at(stamp_s);
  }
  std::optional<VehicleMotion> motion_at(double stamp_s) const {
    return telemetry_.motion_at(stamp_s);
  }
  AdapterStatus status(double now_s) const;

 private:
  void take(const mavlink::Packet& packet, double now_s, Frames& answers);
  bool is_vehicle(const mavlink::Packet& packet);
  void ask_for_telemetry();
  void send_setpoint(double now_s, Frames& due);
  void send_heartbeat(double now_s, Frames& due);
  void send_questions(double now_s, Frames& due);
  void send_commands(double now_s, Frames& due);
  void send_handshake(double now_s, Frames& due);
  std::optional<StreamSetpoint> setpoint(double now_s);
  mavlink::EncodedFrame framed(const mavlink::Message& message);
  Recipient vehicle() const;

  AutopilotOptions options_;
  SetpointStream stream_;
  Handshake handshake_;
  ClockSync clock_;
  Telemetry telemetry_;
  std::optional<std::uint8_t> vehicle_id_;
  std::deque<CommandRequest> intervals_;
  std::optional<double> worked_s_;  // when the newest frame's command was decided
  std::optional<double> next_setpoint_s_;
  std::optional<double> next_heartbeat_s_;
  std::optional<double> next_question_s_;
  std::optional<double> zeros_until_s_;  // a farewell
  std::optional<double> release_s_;      // when control is to be given back
  std::optional<StreamSetpoint> ticked_;
  int answered_ = 0;  // questions about the clock
  std::uint8_t sequence_ = 0;
  AdapterCounts counts_;
};

}  // namespace kestrel
