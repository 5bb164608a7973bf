#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "kestrel/eval/bench.hpp"

namespace kestrel::app {

/// A sequence and what its frames depend on: its files with their sizes and dates.
struct EvaluateInput {
  BenchSequence sequence;
  std::string files;
};

/// The sequences an argument names: a description (NAME.yaml), a sequence.txt or its folder, or a
/// folder that holds several of these, in the order of their names. Throws FileError for a
/// description that cannot be read and for a folder without any; frames that are missing are not
/// noticed here.
std::vector<EvaluateInput> evaluate_inputs(const std::filesystem::path& argument);

}  // namespace kestrel::app
