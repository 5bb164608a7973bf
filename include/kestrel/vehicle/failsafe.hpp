#pragma once

#include <array>

#include "kestrel/vehicle/velocity_command.hpp"

namespace kestrel {

/// What happens to the command while the target is not seen. A camera slower than 1/hold_s frames
/// per second wants a longer hold_s and hover_after_s.
struct LossOptions {
  double hold_s = 0.1;         // the last command is held
  double decay_s = 0.4;        // then it decays with this time constant
  double hover_after_s = 1.0;  // then exact zeros

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// What the command rests on.
enum class CommandState {
  Servo,   // the target was seen in this frame and the law has an answer
  Hold,    // not seen: the last command
  Decay,   // not seen: the last command, fading
  Hover,   // not seen for long, never seen, or something was not finite: zeros
  Sticks,  // an operator's hand, whatever was seen
};

/// All there are, in this order.
inline constexpr std::array<CommandState, 5> kCommandStates{
    CommandState::Servo, CommandState::Hold, CommandState::Decay, CommandState::Hover,
    CommandState::Sticks};

/// A command and what it rests on.
struct FailsafeCommand {
  VelocityCommand command;
  CommandState state = CommandState::Hover;
};

/// Hold, decay, hover: the command unseen_s after the frame in which the target was last seen and
/// `last` was commanded. Hover for times that are negative or not finite, or a `last` that is not
/// finite.
FailsafeCommand after_loss(const VelocityCommand& last, double unseen_s,
                           const LossOptions& options);

/// "servo", "hold", "decay", "hover", "sticks".
const char* name(CommandState state);

}  // namespace kestrel
