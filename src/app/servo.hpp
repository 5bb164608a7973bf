#pragma once

#include "task_setup.hpp"

namespace kestrel::app {

/// Runs a task from its frames to its sink and leaves a run folder.
RunResult servo(const ServoArguments& arguments);

}  // namespace kestrel::app
