#pragma once

#include "compare.hpp"

namespace kestrel::app {

/// Puts a recorded run through other laws: what each would have commanded at each frame. Writes
/// replay.csv, replay.json and index.html into the output folder (default: `laws` inside the run)
/// and prints the table. Returns the exit code.
int compare_run(const CompareArguments& arguments);

}  // namespace kestrel::app
