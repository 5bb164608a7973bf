#pragma once

#include <mutex>
#include <optional>

#include "kestrel/vehicle/velocity_command.hpp"

namespace kestrel {

/// What went through a gate to its sink.
struct GateCounts {
  long commands = 0;
  long zeros = 0;  // of these, exact zeros
};

/// A gate before a sink. Closed, every command that comes is sent on as hover; closing it sends
/// hover at once, from whatever thread, and does not wait for the next frame. Starts closed.
class CommandGate final : public CommandSink {
 public:
  /// The sink must outlive the gate, and be used through it only; so must by_hand, the way of an
  /// operator's own velocities. Null: they go the same way as the law's.
  explicit CommandGate(CommandSink& behind, CommandSink* by_hand = nullptr)
      : behind_(behind), by_hand_(by_hand) {}

  void send(const VelocityCommand& command, double stamp_s) noexcept override;
  long failures() const override;

  /// Zero velocity now, for the frame sent last, and from now on.
  void close() noexcept;
  void open() noexcept;

  /// The command that is sent next is a hand's: it goes by_hand, and `law` goes behind in its
  /// place. Nothing without a way of its own, and forgotten when the gate is closed before.
  void fork(const VelocityCommand& law) noexcept;
  bool is_open() const;
  GateCounts counts() const;

 private:
  void pass(const VelocityCommand& command) noexcept;

  CommandSink& behind_;
  CommandSink* by_hand_;
  mutable std::mutex mutex_;
  bool is_open_ = false;
  bool has_sent_ = false;
  double stamp_s_ = 0;                  // of the last command
  std::optional<VelocityCommand> law_;  // beside the hand's that comes next
  GateCounts counts_;
};

}  // namespace kestrel
