#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "kestrel/eval/evaluation.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own
class App;
}

/// The verb `evaluate`, also for programs that add methods of their own: a library.
namespace kestrel::app {

/// What `evaluate` was asked to do.
struct EvaluateArguments {
  std::vector<std::filesystem::path> inputs;
  std::vector<std::string> methods;   // names; empty: all there are
  std::vector<std::string> settings;  // KEY=VALUE,VALUE,...
  std::filesystem::path output = "runs/evaluate";
  int jobs = 0;  // 0: as many as the machine has cores
  Earlier earlier = Earlier::Used;
};

/// Puts the options of `evaluate` on a command line. `more`: names of methods besides Kestrel's.
/// What cannot be right (an unknown method or key) is a usage error there.
void add_evaluate_options(CLI::App& verb, const std::shared_ptr<EvaluateArguments>& arguments,
                          const std::vector<std::string>& more = {});

/// Runs, prints the tables, writes the output folder; returns the exit code. `more`: methods
/// besides Kestrel's, run as they are, without the settings. Throws for a human's mistake.
int evaluate(const EvaluateArguments& arguments, const std::vector<BenchMethod>& more = {});

}  // namespace kestrel::app
