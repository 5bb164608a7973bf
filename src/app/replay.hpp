#pragma once

#include <memory>

#include "kestrel/ground/replay_station.hpp"

#include "arguments.hpp"

namespace kestrel::app {

/// The verb and its options.
void add_replay(CLI::App& app, const std::shared_ptr<ReplayArguments>& arguments);

/// The run in a folder with the pictures there are: of its video, else of the sequence that its
/// task names, else none; what is missing stands in its notes. Throws std::runtime_error that names
/// what to do for a folder that is none of a run or holds no frame.
Recording load_recording(const std::filesystem::path& folder);

}  // namespace kestrel::app
