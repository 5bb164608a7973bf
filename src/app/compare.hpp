#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "kestrel/lab/lab_runner.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own
class App;
}

/// The verbs of the laboratory: compare, merge, laws.
namespace kestrel::app {

/// What stands on standard output.
enum class Printed { Tables, Json };

/// Whether the runs are drawn in a window while they are made.
enum class Plotted { No, Live };

/// What `compare` was asked to do.
struct CompareArguments {
  std::filesystem::path plan;     // or a run folder
  std::filesystem::path output;   // empty: runs/<name of the plan>, or `laws` in the run folder
  std::vector<std::string> laws;  // to put a run folder through; empty: all
  std::filesystem::path task;     // of a run folder, in place of its own
  int jobs = 0;                   // 0: as many as the machine has cores
  Shard shard{};
  Earlier earlier = Earlier::Used;
  Plotted plotted = Plotted::No;
  Printed printed = Printed::Tables;
};

/// What `merge` was asked to do.
struct MergeArguments {
  std::filesystem::path output;
  std::vector<std::filesystem::path> shards;
  Printed printed = Printed::Tables;
};

/// What `laws` was asked to do.
struct LawsArguments {
  std::string law;  // empty: all of them, briefly
};

/// Put the verbs and their options on a command line.
void add_compare(CLI::App& app, const std::shared_ptr<CompareArguments>& arguments);
void add_merge(CLI::App& app, const std::shared_ptr<MergeArguments>& arguments);
void add_laws(CLI::App& app, const std::shared_ptr<LawsArguments>& arguments);

}  // namespace kestrel::app
