#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <variant>
#include <vector>

#include "kestrel/link/frame.hpp"
#include "kestrel/link/peer_counters.hpp"
#include "kestrel/link/sequence.hpp"
#include "kestrel/link/setpoint.hpp"
#include "kestrel/link/switch_options.hpp"

namespace kestrel {

/// Whom a frame is for: 0 is everybody, also for messages that have no target.
struct FrameTarget {
  std::uint8_t system_id = 0;
  std::uint8_t component_id = 0;
  bool named = false;  // the message has fields for it
};
FrameTarget target_of(const mavlink::FrameView& frame);

struct RouterOptions {
  Recipient vehicle;
  Recipient self;
  double live_s = 5;     // ids heard within are taken for other roles
  double expiry_s = 30;  // ids not heard for longer are forgotten
};

/// Who is where, as MAVLink prescribes (mavlink.io, "Routing"): ids are learned from what peers
/// send; what is for everybody goes to all, what is for a system or component to the peers behind
/// which it was heard, nothing back to where it came from. On top of that, roles: see is_told.
/// Holds kIdsPerPeer ids of each peer; one more takes the place of that peer's longest silent.
class Router {
 public:
  static constexpr std::size_t kIdsPerPeer = 16;

  explicit Router(const RouterOptions& options) : options_(options) {}

  void connect(PeerId peer, LinkRole role);
  void disconnect(PeerId peer);

  /// Learns that the sender is behind the peer and how the frame stands among its frames; a refusal
  /// when it cannot be, and then nothing is learned: a source that is no one, the switch itself or
  /// the vehicle on another link than flight control's, or ids that are live behind another role.
  std::variant<Arrival, Refused> learn(PeerId from, const mavlink::Envelope& envelope,
                                       double now_s);

  /// The peers that are to have a frame of `from`, by rising id; of flight control only whether it
  /// is for it, not whether it may have it. Lives until the next call.
  const std::vector<PeerId>& destinations(PeerId from, const mavlink::FrameView& frame,
                                          double now_s);

 private:
  struct Heard {
    std::uint8_t system_id = 0;  // 0: free
    std::uint8_t component_id = 0;
    double last_s = 0;
    SequenceWindow sequence;
  };
  struct Place {
    LinkRole role = LinkRole::Telemetry;
    std::array<Heard, kIdsPerPeer> heard{};
  };

  std::optional<Refused> refused(LinkRole role, const mavlink::Envelope& envelope,
                                 double now_s) const;
  bool is_behind(const Place& place, const FrameTarget& target, double now_s) const;
  static Heard& slot(Place& place, const mavlink::Envelope& envelope);

  RouterOptions options_;
  std::map<PeerId, Place> places_;
  std::vector<PeerId> destinations_;
};

/// Whether a role is told a message at all: ground stations everything; telemetry everything that
/// is known; vision and scripts what they need of the vehicle (heartbeat, attitude, local position,
/// state in the air, clocks, acknowledgements); flight control nothing unknown. Nobody a
/// SETUP_SIGNING.
bool is_told(LinkRole role, const mavlink::FrameView& frame);

}  // namespace kestrel
