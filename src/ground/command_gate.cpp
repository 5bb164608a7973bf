#include "kestrel/ground/command_gate.hpp"

#include <utility>

namespace kestrel {

void CommandGate::send(const VelocityCommand& command, double stamp_s) noexcept {
  const std::lock_guard<std::mutex> lock(mutex_);
  stamp_s_ = stamp_s;
  has_sent_ = true;
  const auto law = std::exchange(law_, std::nullopt);
  if (law) by_hand_->send(command, stamp_s);
  pass(is_open_ ? law.value_or(command) : VelocityCommand::hover());
}

void CommandGate::fork(const VelocityCommand& law) noexcept {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (is_open_ && by_hand_ != nullptr) law_ = law;
}

/// With the mutex held.
void CommandGate::pass(const VelocityCommand& command) noexcept {
  behind_.send(command, stamp_s_);
  ++counts_.commands;
  counts_.zeros += command.vector().isZero(0) ? 1 : 0;
}

GateCounts CommandGate::counts() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return counts_;
}

long CommandGate::failures() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return behind_.failures() + (by_hand_ != nullptr ? by_hand_->failures() : 0);
}

void CommandGate::close() noexcept {
  const std::lock_guard<std::mutex> lock(mutex_);
  is_open_ = false;
  law_.reset();
  if (has_sent_) pass(VelocityCommand::hover());
}

void CommandGate::open() noexcept {
  const std::lock_guard<std::mutex> lock(mutex_);
  is_open_ = true;
}

bool CommandGate::is_open() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return is_open_;
}

}  // namespace kestrel
