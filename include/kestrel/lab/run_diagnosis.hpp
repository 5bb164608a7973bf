#pragma once

#include <vector>

#include "kestrel/io/run_log.hpp"
#include "kestrel/lab/finding.hpp"
#include "kestrel/loop/task.hpp"

namespace kestrel {

/// Why a recorded run did not converge, or that it did: what the log of a `servo` or `simulate` run
/// of this task shows. Looked at, in this order: seen (share of frames, longest loss), answer (a
/// law without one), error (did it shrink, at which rate against the gain), oscillation (period,
/// growth; the gain the latency allows), local_minimum (stands still with an error left), sign and
/// depth (the image's answer to the commands, vehicle_response), condition, limits (share of the
/// time at them), tilt (attitude known or not). Faults first. Never empty.
std::vector<Finding> diagnosis(const LogFile& log, const Task& task);

}  // namespace kestrel
