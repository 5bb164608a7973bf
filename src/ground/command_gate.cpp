#include "kestrel/ground/command_gate.hpp"

namespace kestrel {

void CommandGate::send(const VelocityCommand& command, double stamp_s) noexcept {
  const std::lock_guard<std::mutex> lock(mutex_);
  behind_.send(is_open_ ? command : VelocityCommand::hover(), stamp_s);
  stamp_s_ = stamp_s;
  has_sent_ = true;
}

long CommandGate::failures() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return behind_.failures();
}

void CommandGate::close() noexcept {
  const std::lock_guard<std::mutex> lock(mutex_);
  is_open_ = false;
  if (has_sent_) behind_.send(VelocityCommand::hover(), stamp_s_);
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
