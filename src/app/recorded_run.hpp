#pragma once

#include <filesystem>

#include "kestrel/io/run_log.hpp"
#include "kestrel/io/task_file.hpp"

namespace kestrel::app {

/// File of a run folder that says where its task was read from: the paths in configuration.yaml
/// are relative to that place.
constexpr const char* kOriginFile = "task_file.txt";

/// True for a folder with the log of a run in it.
bool is_run_folder(const std::filesystem::path& path);

/// A run of `servo` or `simulate` read back.
struct RecordedRun {
  Experiment experiment;
  LogFile log;
};

/// The run in this folder: its log, and the task as it was when it was run. A task that is given
/// stands in for the folder's own. Throws FileError or std::runtime_error for what cannot be read,
/// with what to do.
RecordedRun load_run(const std::filesystem::path& folder, const std::filesystem::path& task);

/// Median time between frames, as a rate; 30 for fewer than two frames.
double rate_hz(const LogFile& log);

}  // namespace kestrel::app
