#pragma once

#include <string>

#include "kestrel/io/summary.hpp"
#include "kestrel/link/autopilot_model.hpp"
#include "kestrel/link/receiver_state.hpp"

/// What a receiver got, as text.
namespace kestrel::app {

/// Header of the log of received commands.
std::string command_columns();

/// One received command as a line of that log.
std::string command_line(const ReceivedCommand& command);

/// The counts of a receiver, as lines of a summary.
Summary receiver_summary(const ReceiverCounts& counts);

/// What an autopilot that was stood in for made of what it got.
void add_counts(Summary& summary, const AutopilotCounts& counts);

}  // namespace kestrel::app
