#include "kestrel/link/control_word.hpp"

namespace kestrel {
namespace {

constexpr std::uint32_t kByte = 0xFF;

std::string commander(const ControlWord& word) {
  return word.owner ? std::string(name(*word.owner)) + " commands the vehicle"
                    : "nobody commands the vehicle: zeros";
}

}  // namespace

std::uint32_t bits_of(const ControlWord& word) {
  const std::uint32_t owner = word.owner ? 1 + std::uint32_t(*word.owner) : 0;
  return std::uint32_t(word.state) | owner << 8;
}

std::optional<ControlWord> control_word(std::uint32_t bits) {
  const std::uint32_t state = bits & kByte;
  const std::uint32_t owner = bits >> 8;
  if (state > std::uint32_t(ControlState::Stopped) || owner > kLinkRoles) return std::nullopt;
  ControlWord word{ControlState(state), std::nullopt};
  if (owner > 0) word.owner = LinkRole(owner - 1);
  return word;
}

std::string words(const ControlWord& word) {
  switch (word.state) {
    case ControlState::Idle:
      return "nobody has commanded the vehicle so far";
    case ControlState::Hold:
    case ControlState::Owned:
      return commander(word);
    case ControlState::Locked:
      return "locked: " + commander(word);
    case ControlState::TakenOver:
      return "taken over by the ground: " + commander(word);
    case ControlState::Stopped:
      return "EMERGENCY STOP: zeros until it is reset";
  }
  return "unknown";
}

}  // namespace kestrel
