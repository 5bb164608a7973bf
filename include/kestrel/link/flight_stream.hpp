#pragma once

#include <cstdint>

#include "kestrel/vehicle/limits.hpp"
#include "kestrel/vehicle/velocity_command.hpp"

namespace kestrel {

/// A setpoint for flight control, and when what it answers to was captured.
struct FlightSetpoint {
  VelocityCommand command;
  double captured_s = 0;
};

/// What goes to flight control: the last setpoint wanted, approached within the limits, as long as
/// it is fresh, and exact zeros from then on; at least every period once it has begun. The numbers
/// are floats of the wire: none leaves the envelope by rounding.
class FlightStream {
 public:
  FlightStream(const CommandLimits& envelope, double period_s);

  /// From now on towards this, until fresh_until_s.
  void want(const FlightSetpoint& setpoint, double fresh_until_s);

  /// From now on zeros.
  void want_zero() { fresh_until_s_ = kNever; }

  /// The vehicle is at rest, whatever was sent before: it has just been reached.
  void start_from_rest(double now_s);

  /// True when a setpoint must go: a period has passed since the last, or what was sent is no
  /// longer wanted and not yet zero.
  bool is_due(double now_s) const;

  /// What to send now. It counts as sent: the next one is measured from it.
  FlightSetpoint next(double now_s);

  bool has_begun() const { return sent_count_ > 0; }
  const VelocityCommand& sent() const { return sent_; }
  std::uint64_t sent_count() const { return sent_count_; }
  std::uint64_t zero_count() const { return zero_count_; }

 private:
  static constexpr double kNever = -1e300;

  CommandLimits envelope_;
  double period_s_;
  FlightSetpoint wanted_;
  double fresh_until_s_ = kNever;
  VelocityCommand sent_;
  double sent_s_ = kNever;
  std::uint64_t sent_count_ = 0, zero_count_ = 0;
};

/// True for exact zeros.
bool is_hover(const VelocityCommand& command);

}  // namespace kestrel
