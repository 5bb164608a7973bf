#pragma once

#include <filesystem>

namespace kestrel {

/// Creates the folder of a run (and its parents) and returns its path: `wanted`, or when that
/// exists the next free of wanted-2, wanted-3, ... An existing folder is never touched, also when
/// two programs ask at once. Throws std::runtime_error with path, cause and remedy.
std::filesystem::path create_run_folder(const std::filesystem::path& wanted);

}  // namespace kestrel
