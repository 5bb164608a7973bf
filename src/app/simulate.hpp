#pragma once

#include "kestrel/eval/hover_metrics.hpp"

#include "task_setup.hpp"

namespace kestrel::app {

/// A flight of the built-in helicopter.
struct SimulatedFlight {
  RunResult run;
  HoverMetrics metrics;
  double path_m = 0;  // flown
};

/// Flies the built-in helicopter through a task and leaves a run folder. Exit code 1 when it did
/// not converge.
SimulatedFlight fly(const SimulateArguments& arguments);

/// The run of that flight.
RunResult simulate(const SimulateArguments& arguments);

/// Flies the task once for each seed, from the start of that seed, into folders of their own below
/// one; prints and writes a table. Exit code 1 when a flight did not converge.
int fly_seeds(const SimulateArguments& arguments);

}  // namespace kestrel::app
