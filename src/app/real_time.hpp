#pragma once

#include "arguments.hpp"

namespace kestrel::app {

/// `simulate --real-time`: the helicopter by the clock, a MAVLink vehicle on UDP and a camera on a
/// stream of frames, for programs that know no simulation. Leaves a run folder with the truth.
/// Exit code 1 when the flight ended at a wall or far away, or was not at its goal at the end of
/// --duration.
int simulate_in_real_time(const SimulateArguments& arguments);

}  // namespace kestrel::app
