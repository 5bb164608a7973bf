#pragma once

#include <limits>
#include <string>
#include <vector>

#include "kestrel/link/receiver_state.hpp"
#include "kestrel/link/switch_core.hpp"
#include "kestrel/loop/decide.hpp"
#include "kestrel/sim/helicopter.hpp"

#include "support/impairment.hpp"

namespace kestrel::test {

/// A helicopter servoed over bad lines through the switch, in virtual time.
struct FlownLoopOptions {
  ImpairmentOptions to_switch;   // the companion's setpoints
  ImpairmentOptions to_vehicle;  // what the switch lets through
  SwitchOptions switching;       // links: 0 flight, 1 vision
  double duration_s = 40;
  double cut_from_s = std::numeric_limits<double>::infinity();  // nothing of the companion's passes
  double cut_until_s = std::numeric_limits<double>::infinity();
  double frozen_from_s = std::numeric_limits<double>::infinity();  // the same command for ever
  double blind_from_s = std::numeric_limits<double>::infinity();   // the target is not seen
  std::string name = "flown loop";                                 // the seed
};

/// The links of the loop, and an envelope half of what the companion asks for.
SwitchOptions loop_switch();

/// A setpoint that reached the vehicle, and when.
struct ObeyedCommand {
  double time_s = 0;
  VelocityCommand command;
  long refused = 0;  // setpoints refused by the vehicle so far: not finite, not supported
};

struct FlownLoop {
  std::vector<HelicopterState> states;  // every kLoopStep_s
  std::vector<ObeyedCommand> obeyed;
  double last_fresh_s =
      0;  // when the last frame was captured of which a command was put on the line
  SwitchStatus status;
  LineCounts to_switch;
  LineCounts to_vehicle;
  ReceiverCounts received;  // by the vehicle

  const HelicopterState& end() const { return states.back(); }
};

constexpr double kLoopStep_s = 0.005;

/// Flies: 30 frames a second of a target of 1 x 1 m, features from the true pose, the loop's own
/// decision; the vehicle obeys the last setpoint for 3 s, as ArduPilot does.
FlownLoop flown_loop(const FlownLoopOptions& options);

/// Metres from the goal, 5 m in front of the target.
double goal_error_m(const HelicopterState& state);

}  // namespace kestrel::test
