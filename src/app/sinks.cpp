#include "sinks.hpp"

#include <stdexcept>

#include "kestrel/link/command_link.hpp"

namespace kestrel::app {
namespace {

class NoSink final : public CommandSink {
 public:
  void send(const VelocityCommand&, double) noexcept override {}
  long failures() const override { return 0; }
};

}  // namespace

std::unique_ptr<CommandSink> open_sink(const std::string& text) {
  if (text.empty() || text == "none") return std::make_unique<NoSink>();
  if (text.rfind("udp://", 0) == 0) return std::make_unique<CommandLink>(parse_address(text));
  throw std::invalid_argument("sink '" + text + "': known are udp://HOST:PORT and none");
}

}  // namespace kestrel::app
