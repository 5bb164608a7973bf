#pragma once

#include "task_setup.hpp"

namespace kestrel::app {

/// Flies the built-in helicopter through a task and leaves a run folder. Exit code 1 when it did
/// not converge.
RunResult simulate(const SimulateArguments& arguments);

}  // namespace kestrel::app
