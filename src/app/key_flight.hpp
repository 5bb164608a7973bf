#pragma once

#include <mutex>
#include <string>

#include "kestrel/ground/command_gate.hpp"
#include "kestrel/ground/flight_mode.hpp"
#include "kestrel/loop/decide.hpp"

namespace kestrel::app {

/// A flight that the keys of a terminal stop and start, where there is no page: Space aborts (zero
/// at once, and it stays so), then r resets to hover, then s starts. Two keys one after the other,
/// so that no slip of a finger sets a vehicle going. Starts flying. Any thread may press.
class KeyFlight {
 public:
  /// Opens the gate, which must outlive this.
  explicit KeyFlight(CommandGate& gate);

  /// Does what the keys say, and answers in words; empty for keys that say nothing. Of several
  /// typed at once only Space counts: they were pasted.
  std::string press(const std::string& typed);

  /// The decision of a frame as it may be flown.
  Decision steered(Decision decision) const;

 private:
  CommandGate& gate_;
  mutable std::mutex mutex_;
  FlightMode mode_ = FlightMode::Servo;
};

/// What is printed once at the start of such a flight, and of one with a page.
constexpr const char* kKeysAlone =
    "terminal: Space aborts (zero velocity at once, until r resets to hover and s starts)";
constexpr const char* kKeysBesidePage =
    "terminal: Space aborts (zero velocity at once, until Reset in the page)";

}  // namespace kestrel::app
