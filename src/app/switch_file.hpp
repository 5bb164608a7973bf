#pragma once

#include <filesystem>
#include <optional>

#include "kestrel/io/rotating_log.hpp"
#include "kestrel/link/switch_loop.hpp"

namespace kestrel::app {

/// A switch as its task file describes it; tasks/switch.md documents every key.
struct SwitchTask {
  SwitchLoopOptions loop;
  std::filesystem::path log;  // empty: none
  RotatingLogOptions log_options;
  std::filesystem::path signing_times;  // empty: no link is signed
  int real_time_priority = 0;           // of the thread that serves the links; 0: as any other
};

/// Throws FileError with the line for every mistake: an unknown key, a value that cannot be, a key
/// file that others may read.
SwitchTask read_switch_task(const std::filesystem::path& file);

}  // namespace kestrel::app
