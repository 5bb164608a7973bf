#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "kestrel/link/autopilot_profile.hpp"
#include "kestrel/link/battery.hpp"
#include "kestrel/link/clock_sync.hpp"
#include "kestrel/link/frame.hpp"
#include "kestrel/link/kinematic_vehicle.hpp"
#include "kestrel/link/telemetry.hpp"

namespace kestrel {

struct AutopilotModelOptions {
  Autopilot autopilot = Autopilot::ArduPilot;
  Recipient me;              // its system and component
  bool starts_armed = true;  // and in the air
  /// The mode it starts in; empty: LOITER of ArduPilot, AUTO.LOITER of PX4.
  std::optional<std::uint32_t> start_mode;
  double boot_s = 0;           // our clock when its own was zero
  double climb_m_s = 1;        // taking off
  double sink_m_s = 0.5;       // landing
  double px4_takeoff_m = 2.5;  // MIS_TAKEOFF_ALT
  double telemetry_hz = 4;     // of attitude and position, until somebody asks for more
  BatteryOptions battery;      // told once a second

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// Something a human at the autopilot would want to know.
struct AutopilotEvent {
  double at_s = 0;
  std::string what;
};

/// What became of the setpoints.
struct AutopilotCounts {
  long setpoints = 0;     // for us
  long obeyed = 0;        // in the control mode, armed, in a frame that is obeyed
  long ignored = 0;       // in another mode, not armed, or fields that are not obeyed
  long refused = 0;       // in a frame that is not obeyed
  long not_finite = 0;    // with a number in use that is not finite
  long commands = 0;      // COMMAND_LONG for us
  long heartbeats = 0;    // of others
  long malformed = 0;     // stretches of bytes that were no frame
  long misaddressed = 0;  // for another vehicle
};

/// The stand-in for a flight controller: the rules by which ArduPilot and PX4 obey setpoints,
/// modes, arming, take-off and landing, as they were seen to do in software. Only the rules: what
/// the vehicle does with reference() is somebody else's, who hands back the truth.
///
/// ArduPilot: obeys setpoints in GUIDED; flies on with the last for 3 s, then stops, and stays in
/// GUIDED. MAV_FRAME_BODY_OFFSET_NED (9) counts as 8; at BODY_FRD (12) it holds its place. A number
/// that is not finite ends the process: it falls silent.
/// PX4: obeys in OFFBOARD, which wants a setpoint not older than 1 s, and leaves it for AUTO.LOITER
/// when there is none for 1 s. Refuses frames 9 and 12. An axis that is not finite is not moved.
/// Both turn the velocities of frame 8 by the yaw alone, at their arrival.
class AutopilotModel {
 public:
  using Frames = std::vector<mavlink::EncodedFrame>;

  /// Throws as AutopilotModelOptions::check.
  explicit AutopilotModel(const AutopilotModelOptions& options = {});

  /// What it answers to a datagram.
  Frames receive(Bytes datagram, const VehicleTruth& truth, double now_s);

  /// Lets time pass; the telemetry that is due. At least as often as the vehicle moves.
  Frames tick(const VehicleTruth& truth, double now_s);

  /// What the vehicle is to do from now on.
  const MotionReference& reference() const { return reference_; }

  std::uint32_t mode() const { return mode_; }
  bool armed() const { return armed_; }
  /// False after a number that ended the process.
  bool alive() const { return alive_; }
  Landed landed(const VehicleTruth& truth) const;
  const AutopilotCounts& counts() const { return counts_; }

  /// The pilot's switch: the mode changes, whoever had control.
  void pilot_chooses(std::uint32_t mode, double now_s);

  /// Events since the last call.
  std::vector<AutopilotEvent> take_events();

 private:
  void take(const mavlink::Packet& packet, const VehicleTruth& truth, double now_s,
            Frames& answers);
  void obey(const mavlink::SetPositionTarget& setpoint, const VehicleTruth& truth, double now_s);
  std::uint8_t obey(const mavlink::CommandLong& command, const VehicleTruth& truth, double now_s);
  std::uint8_t choose_mode(const mavlink::CommandLong& command, const VehicleTruth& truth,
                           double now_s);
  std::uint8_t take_off(double height_m, const VehicleTruth& truth, double now_s);
  bool accepts(const mavlink::SetPositionTarget& setpoint, double now_s);
  void time_out(double now_s);
  void drain(const VehicleTruth& truth, double now_s);
  void climb_or_sink(const VehicleTruth& truth, double now_s);
  bool is_due(std::uint32_t message_id, double now_s);
  mavlink::Message report(std::uint32_t message_id, const VehicleTruth& truth, double now_s) const;
  mavlink::EncodedFrame framed(const mavlink::Message& message);
  void enter(std::uint32_t mode, double now_s);
  void tell(double now_s, const std::string& what);

  AutopilotModelOptions options_;
  AutopilotProfile profile_;
  std::uint32_t mode_;
  bool armed_;
  bool alive_ = true;
  MotionReference reference_;
  double flown_s_ = 0;                // armed and off the ground
  std::optional<double> ticked_s_;    // last
  std::optional<double> setpoint_s_;  // arrival of the last that could be obeyed
  std::optional<double> climb_to_m_;  // down, while it takes off
  std::map<std::uint32_t, double> interval_s_;
  std::map<std::uint32_t, double> next_s_;
  std::uint8_t sequence_ = 0;
  AutopilotCounts counts_;
  std::vector<AutopilotEvent> events_;
};

}  // namespace kestrel
