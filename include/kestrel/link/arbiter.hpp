#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "kestrel/link/peer_counters.hpp"
#include "kestrel/link/switch_options.hpp"
#include "kestrel/link/switch_status.hpp"

namespace kestrel {

/// A source of setpoints and its rank.
struct Claimant {
  SourceId id;
  LinkRole role = LinkRole::Script;
  int priority = 0;
};

/// Who has control. There is one owner or none:
/// * A source takes control when nobody has it, or when its priority is above the owner's. Among
///   equals the owner stays.
/// * An owner whose setpoints are no longer fresh, or that is dead or gone, loses it to the live
///   source of the highest priority, else to nobody; when locked it keeps it.
/// * A lock keeps control with its owner; a take-over keeps it with the ground. Both last until
///   released, also when those who asked for them are gone.
/// * The emergency stop leaves nobody in control until it is reset.
/// Whenever the owner changes, the caller sends a zero: the setpoint that claims control is not
/// itself obeyed.
class Arbiter {
 public:
  static constexpr std::size_t kSourcesPerPeer = 4;  // no peer takes the room of another

  /// dead_after_s: a source without a heartbeat for longer is dead, from its first word on.
  explicit Arbiter(double dead_after_s);

  void heartbeat(const Claimant& source, double now_s);

  /// A setpoint that is fit to be obeyed until fresh_until_s: empty when it is the owner's, or
  /// makes its source the owner.
  std::optional<Refused> offer(const Claimant& source, double fresh_until_s, double now_s);

  /// Lets time pass: silent and dead owners lose control.
  void update(double now_s);

  void forget(PeerId peer, double now_s);

  void take_over();
  /// False when there is nobody to lock control to, or it is taken over or stopped.
  bool lock();
  void release();
  void stop() { stopped_ = had_owner_ = true; }
  void reset();

  ControlState state() const;
  /// The one in control; empty while stopped.
  std::optional<SourceId> owner() const;
  /// Whether the source is in control, or could be for the asking.
  bool may_command(const SourceId& source, LinkRole role) const;
  /// Sources that are dead now and were not when this was last asked.
  std::vector<SourceId> take_dead();

 private:
  struct Source {
    Claimant who;
    double heartbeat_s = 0;    // its last, or else its first word
    double fresh_until_s = 0;  // its last setpoint
    bool dead = false;
    bool told_dead = false;
  };

  Source* find(const SourceId& id);
  Source* known(const Claimant& source, double now_s);
  void make_room(PeerId peer);
  std::optional<Refused> refused(const Source& source) const;
  bool is_candidate(const Source& source, double now_s) const;
  void hand_over(double now_s);
  void own(const std::optional<Claimant>& owner);

  double dead_after_s_;
  std::vector<Source> sources_;
  std::optional<Claimant> owner_;
  bool had_owner_ = false, locked_ = false, taken_over_ = false, stopped_ = false;
};

}  // namespace kestrel
