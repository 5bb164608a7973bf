#pragma once

#include "kestrel/ground/command_post.hpp"

namespace kestrel {

/// What the operator lets the chain do.
enum class FlightMode {
  Hover,    // zero velocity, until the commander starts
  Servo,    // what the chain decides
  Sticks,   // what the commander's hand asks for, as long as it holds the sticks; then hover
  Aborted,  // zero velocity, until the commander resets, and then hover
};

/// "hover", "servo", "sticks", "aborted".
const char* name(FlightMode mode);

/// The mode after a command, and what to tell who gave it.
struct ModeChange {
  FlightMode mode = FlightMode::Hover;
  Answer answer;
};

/// What Abort, Hover, Reset, Start and Grip make of a mode; all else leaves it. Doubt means hover:
/// no command but Start leads to Servo, from hover only, none but Grip to Sticks, and Abort is left
/// by Reset only.
ModeChange changed(FlightMode mode, Ask ask);

}  // namespace kestrel
