#include "kestrel/vehicle/failsafe.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace kestrel {

void LossOptions::check() const {
  const auto require = [](bool good, const char* what, double value) {
    if (good) return;
    std::ostringstream message;
    message << what << ", is " << value;
    throw std::invalid_argument(message.str());
  };
  require(std::isfinite(hold_s) && hold_s >= 0, "hold_s: must be finite and not negative (s)",
          hold_s);
  require(std::isfinite(decay_s) && decay_s > 0, "decay_s: must be finite and positive (s)",
          decay_s);
  require(std::isfinite(hover_after_s) && hover_after_s > 0 && hover_after_s >= hold_s,
          "hover_after_s: must be finite, positive and not less than hold_s (s)", hover_after_s);
}

FailsafeCommand after_loss(const VelocityCommand& last, double unseen_s,
                           const LossOptions& options) {
  constexpr FailsafeCommand kHover{};
  if (!is_finite(last) || !(unseen_s >= 0)) return kHover;
  if (!(unseen_s < options.hover_after_s)) return kHover;
  if (unseen_s <= options.hold_s) return {last, CommandState::Hold};
  const double left = std::exp(-(unseen_s - options.hold_s) / options.decay_s);
  const auto fading = VelocityCommand::from_vector(left * last.vector());
  return is_finite(fading) ? FailsafeCommand{fading, CommandState::Decay} : kHover;
}

const char* name(CommandState state) {
  switch (state) {
    case CommandState::Servo:
      return "servo";
    case CommandState::Hold:
      return "hold";
    case CommandState::Decay:
      return "decay";
    case CommandState::Hover:
      return "hover";
    case CommandState::Sticks:
      return "sticks";
  }
  return "unknown";
}

}  // namespace kestrel
