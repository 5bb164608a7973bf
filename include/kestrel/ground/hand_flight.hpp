#pragma once

#include "kestrel/loop/decide.hpp"
#include "kestrel/vehicle/velocity_command.hpp"

namespace kestrel {

/// What an operator's sticks ask for, for as long as a hand holds them: a dead man's handle. Held
/// sticks say where they are at least ten times a second; when nothing fresh was said for kFresh_s
/// they are let go, whatever became of the hand, its page or the line. No clock: times are of one
/// of the caller's, s.
class HeldSticks {
 public:
  /// Two of three values may be lost at ten a second; shorter than the switch's dead man, 0.5 s.
  static constexpr double kFresh_s = 0.3;

  /// A hand takes them: in their middle.
  void grip(double now_s);

  /// Where they are: velocities of the heading frame, as large as anybody likes; not finite: let
  /// go. Nothing for sticks that are not held: only grip() takes them.
  void push(const VelocityCommand& wanted, double now_s);

  void let_go();

  /// False also for a time that is not a number.
  bool are_held(double now_s) const;

  /// What they ask for; exact zeros when they are not held.
  VelocityCommand wanted(double now_s) const;

 private:
  bool is_gripped_ = false;
  double heard_s_ = 0;
  VelocityCommand wanted_;
};

/// A frame's decision with the command of a hand in place of the law's: within the limits, and
/// changed from the command of the frame before (in `before`) no faster than they allow, over
/// HeldSticks::kFresh_s at most; zeros where no time since then is known. What the law wanted is
/// kept, to be looked at; of the law nothing is remembered that could be resumed. Its state is
/// Sticks; Hover where no time is known.
Decision by_hand(Decision decision, const VelocityCommand& wanted, const DecisionState& before,
                 const CommandLimits& limits);

/// The decision of a chain that may not move: exact zeros, and nothing remembered that could be
/// resumed but how fast the loop is. What the law wants is kept, to be looked at.
Decision stopped(Decision decision);

}  // namespace kestrel
