#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kestrel/geometry/attitude.hpp"
#include "kestrel/ground/ground_station.hpp"
#include "kestrel/io/summary.hpp"
#include "kestrel/io/wire_log.hpp"
#include "kestrel/link/autopilot_adapter.hpp"
#include "kestrel/vehicle/velocity_command.hpp"

namespace kestrel::app {

/// Where commands go, and what comes back from there.
struct Sink {
  std::unique_ptr<CommandSink> commands;
  /// The vehicle's attitude when the frame with a stamp was captured; null for a sink that does not
  /// know.
  std::function<std::optional<Attitude>(double stamp_s)> attitude;
  /// Adds what became of the commands to a summary; null when there is nothing to say.
  std::function<void(Summary&)> report;
  /// When commands left since the last call; null for a sink that does not know.
  std::function<std::vector<WireTime>()> take_times;
  /// What is known of the vehicle and of the way to it now; null for a sink that does not know.
  Facts facts{};
  /// Whether what is at the other end lives by the clock on the wall: what is simulated for it must
  /// not go faster.
  bool lives_by_the_clock = false;
};

/// The sink of a task: "udp://HOST:PORT" (setpoints and nothing else), "autopilot:udp://HOST:PORT"
/// (AutopilotLink), or "none" and "" for one that sends nothing. stamp_origin_s: of the frames, see
/// AutopilotLink. Throws std::invalid_argument for anything else.
Sink open_sink(const std::string& text, const AutopilotOptions& options,
               std::optional<double> stamp_origin_s);

/// Throws as open_sink for a text that is none of these; opens nothing.
void check_sink(const std::string& text);

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
