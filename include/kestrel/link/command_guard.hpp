#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "kestrel/link/message.hpp"
#include "kestrel/link/peer_counters.hpp"
#include "kestrel/link/sender_clock.hpp"
#include "kestrel/link/sequence.hpp"
#include "kestrel/link/switch_status.hpp"
#include "kestrel/vehicle/velocity_command.hpp"

namespace kestrel {

struct CommandGuardOptions {
  VelocityCommand speed;        // the envelope: beyond it a command is scaled down
  double time_to_live_s = 0.5;  // since the capture
  double forget_s = 2;          // a source silent for longer starts afresh
};

/// A setpoint that may be obeyed: within the envelope, and when its frame was captured by the clock
/// of now_s.
struct GuardedSetpoint {
  VelocityCommand command;
  double captured_s = 0;
};

/// Whether a setpoint is fit to be obeyed, whoever has control. Keeps for each source how its clock
/// stands to ours and its last capture: time_boot_ms must neither go back, nor lag by more than
/// time_to_live_s behind the shortest way. A stamp ahead of any way by more than that says that
/// the clock was set, or that all before it was old: it is refused, and believed from the second
/// one on that says the same. A clock that is set back is heard again after forget_s of silence, or
/// by a new connection. What is refused never makes an older setpoint pass.
class CommandGuard {
 public:
  static constexpr std::size_t kSourcesPerPeer = 4;  // no peer takes the room of another

  explicit CommandGuard(const CommandGuardOptions& options);

  /// `arrival` is that of its sequence number: only a new one is obeyed.
  std::variant<GuardedSetpoint, Refused> check(const SourceId& source,
                                               const mavlink::SetPositionTarget& setpoint,
                                               Arrival arrival, double now_s);

  void forget(PeerId peer);

 private:
  struct Source {
    SourceId id;
    SenderClock clock;
    std::optional<SenderClock> leapt;  // the clock by a stamp of the future, until confirmed
    std::uint32_t captured_ms = 0;     // of the last that was accepted
    double heard_s = 0;
  };

  std::optional<Refused> refused(Source& source, std::uint32_t time_boot_ms, double now_s) const;
  bool is_confirmed_leap(Source& source, std::uint32_t time_boot_ms, double now_s) const;
  Source* heard(const SourceId& id, std::uint32_t time_boot_ms, double now_s);

  CommandGuardOptions options_;
  std::vector<Source> sources_;
};

/// Why the content alone forbids to obey it: a float that is NaN, infinite or denormal, ignored
/// ones included, or another frame or type mask than velocities with a yaw rate in the heading
/// frame.
std::optional<Refused> refused_content(const mavlink::SetPositionTarget& setpoint);

/// The largest limits of floats that are not above these: what is within them is within these also
/// after rounding to the floats of the wire.
VelocityCommand float_limits(const VelocityCommand& limits);

}  // namespace kestrel
