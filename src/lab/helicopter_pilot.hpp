#pragma once

#include <optional>

#include "kestrel/lab/helicopter_run.hpp"
#include "kestrel/lab/helicopter_sight.hpp"

#include "law_timer.hpp"

namespace kestrel {

/// Who flies a helicopter run: sight, law, limits, failsafe.
class HelicopterPilot {
 public:
  HelicopterPilot(const HelicopterSetup& setup, const LabClock& clock);

  /// Takes the frame; a new command, when one is due.
  void fly(const HelicopterFrame& frame);

  /// Puts the command that holds, and what it rests on, into the step.
  void tell(HelicopterStep& step) const;

  /// Spent in the law, s.
  double law_s() const { return timer_.all_s(); }

 private:
  HelicopterLawAnswer answer(const HelicopterLawInput& input);
  void obey(const BodyTwist& twist, const HelicopterFrame& frame);
  void do_without(double time_s);

  const HelicopterSetup& setup_;
  LawTimer timer_;
  HelicopterSight sight_;
  LawState memory_;
  HelicopterStep last_;            // the fields of the command only
  VelocityCommand servo_command_;  // the last one that the law gave, after limits
  std::optional<double> servo_s_;  // when
};

}  // namespace kestrel
