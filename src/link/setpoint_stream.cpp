#include "kestrel/link/setpoint_stream.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "kestrel/link/setpoint.hpp"

namespace kestrel {
namespace {

void require(bool good, const char* what, double value) {
  if (good) return;
  std::ostringstream message;
  message << what << ", is " << value;
  throw std::invalid_argument(message.str());
}

bool is_zero(const VelocityCommand& command) { return command.vector().isZero(0); }

}  // namespace

void SetpointStreamOptions::check() const {
  constexpr double kLatestZero_s = 0.5;
  require(time_to_live_s > 0 && time_to_live_s <= zero_after_s,
          "time_to_live_s: must be positive and not more than zero_after_s (s)", time_to_live_s);
  require(std::isfinite(decay_s) && decay_s > 0, "decay_s: must be finite and positive (s)",
          decay_s);
  require(zero_after_s > 0 && zero_after_s <= kLatestZero_s,
          "zero_after_s: must be positive and not more than 0.5 (s)", zero_after_s);
  require(std::isfinite(zeros_for_s) && zeros_for_s >= 0,
          "zeros_for_s: must be finite and not negative (s)", zeros_for_s);
}

const char* name(StreamState state) {
  switch (state) {
    case StreamState::Waiting:
      return "waiting";
    case StreamState::Fresh:
      return "fresh";
    case StreamState::Decay:
      return "decay";
    case StreamState::Zero:
      return "zero";
    case StreamState::Silent:
      return "silent";
  }
  return "unknown";
}

SetpointStream::SetpointStream(const SetpointStreamOptions& options) : options_(options) {
  options_.check();
}

void SetpointStream::decide(const VelocityCommand& command, double capture_s, double now_s) {
  ++counts_.decided;
  const bool sendable = is_sendable(command) && std::isfinite(capture_s) && std::isfinite(now_s);
  if (!sendable) {
    ++counts_.not_finite;
    command_ = VelocityCommand::hover();
    return;
  }
  const double capture = std::min(capture_s, now_s);
  if (capture_s_ && capture <= *capture_s_) {
    if (is_zero(command)) {
      command_ = command;
    } else {
      ++counts_.stale;
    }
    return;
  }
  command_ = command;
  capture_s_ = capture;
}

StreamState SetpointStream::state(double now_s) const {
  if (!capture_s_) return StreamState::Waiting;
  const double age = now_s - *capture_s_;
  if (age <= options_.time_to_live_s) return StreamState::Fresh;
  if (age < options_.zero_after_s) return StreamState::Decay;
  // Also for a time that is not a number.
  if (!(age >= options_.zero_after_s + options_.zeros_for_s)) return StreamState::Zero;
  return options_.then == AfterZeros::Silence ? StreamState::Silent : StreamState::Zero;
}

std::optional<StreamSetpoint> SetpointStream::at(double now_s) const {
  const StreamState now = state(now_s);
  if (now == StreamState::Silent) return std::nullopt;
  if (now == StreamState::Fresh) return StreamSetpoint{command_, *capture_s_, now};
  if (now == StreamState::Decay) {
    const double late_s = now_s - *capture_s_ - options_.time_to_live_s;
    const double left = std::exp(-late_s / options_.decay_s);
    return StreamSetpoint{VelocityCommand::from_vector(left * command_.vector()), *capture_s_, now};
  }
  return StreamSetpoint{VelocityCommand::hover(), now_s, now};
}

std::optional<double> SetpointStream::age_s(double now_s) const {
  if (!capture_s_) return std::nullopt;
  return now_s - *capture_s_;
}

}  // namespace kestrel
