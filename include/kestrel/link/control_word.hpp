#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "kestrel/link/switch_options.hpp"
#include "kestrel/link/switch_status.hpp"

namespace kestrel {

/// Who commands a vehicle behind a switch, as the switch tells its peers: in custom_mode of its
/// heartbeats and in result_param2 of its answers.
struct ControlWord {
  ControlState state = ControlState::Idle;
  std::optional<LinkRole> owner;  // the role of who has control; empty: nobody has
};

/// The state in the lowest byte, one more than the owner's role in the next, 0 for nobody.
std::uint32_t bits_of(const ControlWord& word);

/// The inverse; empty for bits that mean nothing.
std::optional<ControlWord> control_word(std::uint32_t bits);

/// For a human: "vision commands the vehicle", "EMERGENCY STOP: zeros until it is reset", ...
std::string words(const ControlWord& word);

}  // namespace kestrel
