#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kestrel/link/peer_counters.hpp"
#include "kestrel/link/switch_status.hpp"

namespace kestrel {

/// The events of a switch until somebody takes them: kMost at most, the later ones are dropped and
/// counted, for a log that nobody reads must not grow and its beginning tells most.
class SwitchLog {
 public:
  static constexpr std::size_t kMost = 1024;

  void add(double stamp_s, PeerId peer, SwitchEventKind kind, std::string words);

  /// A frame refused, the count-th of that peer and reason: worth a line the 1st, 10th, 100th time
  /// and so on, so that a flood does not write the log full.
  void refused(double stamp_s, PeerId peer, Refused reason, std::uint64_t count);

  std::vector<SwitchEvent> take();

  std::uint64_t dropped() const { return dropped_; }

 private:
  std::vector<SwitchEvent> events_;
  std::uint64_t dropped_ = 0;
};

}  // namespace kestrel
