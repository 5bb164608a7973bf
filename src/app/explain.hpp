#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "compare.hpp"

namespace kestrel::app {

/// What `explain` was asked to do.
struct ExplainArguments {
  std::filesystem::path input;    // a task file or a run folder
  std::filesystem::path task;     // of a run folder, in place of its own
  std::optional<double> rate_hz;  // absent: the run's, or the task's source's
  double latency_s = 0;
  Printed printed = Printed::Tables;
};

/// Puts the verb and its options on a command line.
void add_explain(CLI::App& app, const std::shared_ptr<ExplainArguments>& arguments);

}  // namespace kestrel::app
