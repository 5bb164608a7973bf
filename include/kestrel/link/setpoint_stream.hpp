#pragma once

#include <optional>

#include "kestrel/vehicle/velocity_command.hpp"

namespace kestrel {

/// What is sent when zeros have been sent for long enough.
enum class AfterZeros {
  Silence,  // nothing: the autopilot's own failsafe takes over
  Zeros,    // zeros for ever: the autopilot holds its place for as long as the link lives
};

/// How a stream of setpoints ages. Ages count from the capture of the frame a command was decided
/// for, never from its arrival: a frozen picture behind a living thread is old.
struct SetpointStreamOptions {
  double time_to_live_s = 0.25;  // up to this age a command is sent as it was decided
  double decay_s = 0.1;          // then it fades with this time constant
  double zero_after_s = 0.5;     // from this age on: exact zeros
  double zeros_for_s = 2.0;      // so long, then what `then` says
  AfterZeros then = AfterZeros::Silence;

  /// Throws std::invalid_argument that names the first option out of range. zero_after_s is at most
  /// 0.5: PX4 leaves its mode after 1.0 s, ArduPilot would fly on for 3 s.
  void check() const;
};

/// What a setpoint of the stream rests on.
enum class StreamState {
  Waiting,  // nothing decided yet: zeros
  Fresh,    // the command as decided
  Decay,    // too old: fading
  Zero,     // older still: exact zeros
  Silent,   // nothing is sent
};

/// "waiting", "fresh", "decay", "zero", "silent".
const char* name(StreamState state);

struct StreamSetpoint {
  VelocityCommand command;  // finite
  double stamp_s = 0;       // when its frame was captured; of zeros: now, when they were decided
  StreamState state = StreamState::Waiting;
};

struct StreamCounts {
  long decided = 0;
  long not_finite = 0;  // of these, with a number that is not finite: zeros instead
  long stale = 0;       // of these, for a frame not newer than one before: not obeyed, unless zeros
};

/// From the commands decided at the rate of the frames to the setpoints sent at a rate of their
/// own. All times are of one clock, which the caller brings; no call depends on how often at() is
/// asked.
class SetpointStream {
 public:
  /// Throws as SetpointStreamOptions::check.
  explicit SetpointStream(const SetpointStreamOptions& options = {});

  /// A command for the frame captured at capture_s (taken as now when later). One that is not
  /// finite, or has no time, becomes zeros at once. For a frame not newer than the last a command
  /// does not become young again: it is passed over, but zeros are obeyed, whatever their stamp.
  void decide(const VelocityCommand& command, double capture_s, double now_s);

  /// What is to be sent at now_s; empty for silence.
  std::optional<StreamSetpoint> at(double now_s) const;

  StreamState state(double now_s) const;

  /// Seconds since the capture of the newest frame; empty before the first.
  std::optional<double> age_s(double now_s) const;

  const StreamCounts& counts() const { return counts_; }

 private:
  SetpointStreamOptions options_;
  VelocityCommand command_;
  std::optional<double> capture_s_;
  StreamCounts counts_;
};

}  // namespace kestrel
