#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "kestrel/link/setpoint.hpp"
#include "kestrel/vehicle/limits.hpp"

namespace kestrel {

/// What is behind a link, hence what it may say to flight control and what it is told.
enum class LinkRole {
  Flight,     // the autopilot: the one who is commanded
  Vision,     // the companion computer that servoes
  Ground,     // a ground station: the operator
  Script,     // a program of lower rank
  Telemetry,  // listens only
};
constexpr std::size_t kLinkRoles = 5;

/// "flight", "vision", "ground", "script", "telemetry".
const char* name(LinkRole role);

/// Priority of the setpoints of a role: ground 100, vision 50, script 10; 0 for who may send none.
int default_priority(LinkRole role);

/// How the bytes of a link come: as datagrams, each of whole frames, or as a stream.
enum class Transport { Datagram, Stream };

/// Frames that a peer may send: `burst` at once, `frames_per_s` in the long run.
struct FlowLimit {
  double frames_per_s = 2000;
  double burst = 400;
};

/// What a link may send to flight control beyond its role.
struct LinkPermissions {
  bool arm = false;             // vision, script: arm and take off (MAV_CMD 400, 22)
  bool manual_control = false;  // ground: the sticks of MANUAL_CONTROL
  bool aid_estimator = false;   // vision: poses, speeds and landing targets for the estimator
};

/// One link of the switch. A key, where it has one, makes every frame of it signed, in both
/// directions.
struct SwitchLink {
  std::string name;
  LinkRole role = LinkRole::Telemetry;
  Transport transport = Transport::Datagram;
  int priority = 0;  // of its setpoints; 0: that of its role
  FlowLimit flow;
  LinkPermissions may;
};

/// Whose ids the setpoints bear that go to flight control.
enum class SetpointIds { Switch, Owner };

/// The switch: its links and what it lets through.
struct SwitchOptions {
  std::vector<SwitchLink> links;
  Recipient vehicle;       // flight control
  Recipient self{1, 192};  // the switch: MAV_COMP_ID_ONBOARD_COMPUTER2
  SetpointIds setpoint_ids = SetpointIds::Switch;
  CommandLimits envelope;           // nothing beyond leaves for flight control
  double rate_hz = 20;              // of the setpoints to flight control
  double deadman_s = 0.5;           // after the owner's last setpoint: zeros
  double time_to_live_s = 0.5;      // of a setpoint, since its capture
  double heartbeat_period_s = 1;    // expected of sources, and kept by the switch
  int missed_heartbeats = 5;        // this many: the source is dead
  std::size_t max_peers = 16;       // of one link; more are not heard
  std::uint64_t signing_floor = 0;  // signatures are stamped later than this (10 us)

  /// Throws std::invalid_argument that names the option and says what is wrong with it.
  void check() const;
};

}  // namespace kestrel
