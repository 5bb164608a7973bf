#pragma once

#include <string>

#include "kestrel/io/summary.hpp"
#include "kestrel/link/receiver_state.hpp"

/// What a receiver got, as text.
namespace kestrel::app {

/// Header of the log of received commands.
std::string command_columns();

/// One received command as a line of that log.
std::string command_line(const ReceivedCommand& command);

/// The counts of a receiver, as lines of a summary.
Summary receiver_summary(const ReceiverCounts& counts);

}  // namespace kestrel::app
