#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "kestrel/link/switch_core.hpp"

namespace kestrel::fuzz {

/// The key of the link "signed".
const mavlink::SigningKey& shared_key();

/// One link of each role, the script's with a key, ground a stream.
SwitchOptions watched_options();

/// The links of watched_options.
enum WatchedLink : std::size_t { kFlight, kVision, kGround, kScript, kTelemetry, kWatchedLinks };

/// A switch and one who looks at everything that leaves it: the oracle of the fuzzers. It shares no
/// code with the rules it checks. A wrong delivery ends the program, naming what was wrong.
class WatchedSwitch {
 public:
  WatchedSwitch();

  void connect(PeerId peer, std::size_t link);
  void disconnect(PeerId peer);
  void receive(PeerId peer, Bytes bytes);
  void tick();
  void shut_down();
  void pass(double duration_s) { time_.now_s += duration_s; }

  double now_s() const { return time_.now_s; }
  double unix_s() const { return 1.7e9 + time_.now_s; }
  const std::map<PeerId, std::size_t>& links() const { return links_; }
  const SwitchCore& core() const { return core_; }
  SwitchTime time() const { return {time_.now_s, unix_s()}; }

  /// From here on whoever asks for a climb must not be obeyed, see tell_built_story.
  void climbing_is_wrong() { climbing_is_wrong_ = true; }
  /// True after an accepted emergency stop, until an accepted reset.
  bool is_stopped() const { return stopped_; }
  /// True after an accepted take-over, until an accepted release.
  bool is_taken_over() const { return taken_over_; }

 private:
  bool has_flight() const;
  void look(const std::vector<Delivery>& deliveries, std::optional<PeerId> from);
  void look_at_ack(const mavlink::FrameView& frame);
  void look_at_flight(const mavlink::FrameView& frame, std::optional<PeerId> from);
  void look_at_setpoint(const mavlink::SetPositionTarget& setpoint);

  SwitchOptions options_ = watched_options();
  SwitchCore core_;
  SwitchTime time_{10, 0};
  std::map<PeerId, std::size_t> links_;
  std::optional<SourceId> owner_;
  VelocityCommand sent_;
  double sent_s_ = 0, last_word_s_ = -1e9;
  long zeros_ = 0;
  bool climbing_is_wrong_ = false, stopped_ = false, taken_over_ = false;
  bool shut_ = false;
};

}  // namespace kestrel::fuzz
