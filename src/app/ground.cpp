#include "ground.hpp"

#include <utility>

#include <fmt/format.h>

#include "progress.hpp"

namespace kestrel::app {

Ground::Ground(const GroundArguments& a, const Task& task, CommandSink& sink, Facts facts)
    : sink_(sink) {
  if (!a.port) return;
  GroundOptions options;
  options.host = a.host;
  options.port = *a.port;
  const bool from_file = !a.token.empty();
  const AccessToken token = from_file ? load_token(a.token) : random_token();
  gate_ = std::make_unique<CommandGate>(sink);
  station_ =
      std::make_unique<GroundStation>(options, token, task, *gate_, monotonic_s, std::move(facts));
  // A token of a file is known to who may read the file, and printed nowhere.
  const std::string address = station_->address();
  fmt::print(stderr, "ground station: {}\n",
             from_file ? address.substr(0, address.find('#')) : address);
  fmt::print(stderr, "                hovers until Start is pressed there; commands at port {}\n",
             station_->command_port());
}

}  // namespace kestrel::app
