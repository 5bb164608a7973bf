#pragma once

#include <memory>
#include <string>

#include "kestrel/vehicle/velocity_command.hpp"

namespace kestrel::app {

/// The sink of a task: "udp://HOST:PORT" (MAVLink), or "none" and "" for one that sends nothing.
/// Throws std::invalid_argument for anything else.
std::unique_ptr<CommandSink> open_sink(const std::string& text);

/// Sends each command to two sinks.
class TeeSink final : public CommandSink {
 public:
  TeeSink(CommandSink& first, CommandSink& second) : first_(first), second_(second) {}
  void send(const VelocityCommand& command, double stamp_s) noexcept override {
    first_.send(command, stamp_s);
    second_.send(command, stamp_s);
  }
  long failures() const override { return first_.failures() + second_.failures(); }

 private:
  CommandSink& first_;
  CommandSink& second_;
};

}  // namespace kestrel::app
