#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "compare.hpp"

namespace kestrel::app {

/// What `switch` was asked to do: to run one, or to ask one that runs.
struct SwitchArguments {
  std::filesystem::path task;    // empty: ask
  std::filesystem::path status;  // local socket of the one to ask
  Printed printed = Printed::Tables;
};

/// What `key` was asked to do.
struct KeyArguments {
  std::filesystem::path file;  // to make
};

/// Put the verbs and their options on a command line.
void add_switch(CLI::App& app, const std::shared_ptr<SwitchArguments>& arguments);
void add_key(CLI::App& app, const std::shared_ptr<KeyArguments>& arguments);

}  // namespace kestrel::app
