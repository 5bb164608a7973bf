#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "kestrel/link/key_file.hpp"

#include "switch.hpp"
#include "verbs.hpp"

namespace kestrel::app {

void add_key(CLI::App& app, const std::shared_ptr<KeyArguments>& a) {
  auto* verb = app.add_subcommand("key", "Make a new key to sign MAVLink messages with");
  verb->add_option("FILE", a->file, "File to make, for its owner only (mode 0600)")->required();
}

int run(const KeyArguments& a) {
  mavlink::write_key(a.file, mavlink::random_key());
  fmt::print("{}: a new key; copy it, over a channel you trust, to who shall share it\n",
             a.file.string());
  return 0;
}

}  // namespace kestrel::app
