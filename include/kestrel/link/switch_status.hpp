#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kestrel/link/address.hpp"
#include "kestrel/link/peer_counters.hpp"
#include "kestrel/link/switch_options.hpp"
#include "kestrel/vehicle/velocity_command.hpp"

namespace kestrel {

/// One who commands: a component of a system, behind a peer.
struct SourceId {
  PeerId peer = 0;
  std::uint8_t system_id = 0;
  std::uint8_t component_id = 0;
};
bool operator==(const SourceId& a, const SourceId& b);
bool operator!=(const SourceId& a, const SourceId& b);

/// What is worth a line of the log.
enum class SwitchEventKind {
  Connected,
  Disconnected,
  Refused,       // a peer's 1st, 10th, 100th ... frame of that reason
  OwnerChanged,  // another source, or none, has control; a zero went out
  Deadman,       // the owner fell silent, or its frames froze
  SourceDead,    // missed its heartbeats
  TakenOver,     // by the ground; until released
  Locked,        // to its owner; until released
  Released,
  EmergencyStop,  // until reset
  Reset,
  ControlDenied,  // what the ground asked for cannot be: a lock without an owner
  TooManyPeers,
  Shutdown,
};

/// "connected", "refused", "owner changed", ...
const char* name(SwitchEventKind kind);

/// One line of the log.
struct SwitchEvent {
  double stamp_s = 0;  // of the call that brought it about
  PeerId peer = 0;     // who did it; 0 for the switch itself
  SwitchEventKind kind = SwitchEventKind::Connected;
  std::string words;
};

/// Who has control, and by what right. What stands lower dominates what stands higher.
enum class ControlState {
  Idle,       // nobody has had control so far: nothing is sent
  Hold,       // nobody has control: zeros are sent
  Owned,      // the owner's setpoints are sent
  Locked,     // the same, and nobody else may take it; zeros when the owner is silent
  TakenOver,  // only the ground may have control
  Stopped,    // emergency stop: zeros until the ground resets it
};

/// "idle", "hold", "owned", "locked", "taken over", "stopped".
const char* name(ControlState state);

struct PeerStatus {
  PeerId peer = 0;
  std::size_t link = 0;  // index in the options
  Address from;
  double connected_s = 0;              // when
  std::optional<double> last_heard_s;  // when an intact frame of it was read
  PeerCounters counters;
};

/// The switch at one moment.
struct SwitchStatus {
  double now_s = 0;
  ControlState control = ControlState::Idle;
  std::optional<SourceId> owner;
  VelocityCommand sent;                   // the last setpoint to flight control
  std::uint64_t setpoints_sent = 0;       // to flight control, zeros among them
  std::uint64_t zeros_sent = 0;           // of these
  std::uint64_t newest_signature = 0;     // accepted so far: the floor after a restart
  std::uint64_t events_dropped = 0;       // nobody took them in time
  std::uint64_t unknown_peer_chunks = 0;  // bytes of peers that are not connected: not read
  std::vector<PeerStatus> peers;          // by rising id
  std::vector<PeerCounters> departed;     // of each link: its peers that are gone, summed
};

}  // namespace kestrel
