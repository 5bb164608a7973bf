#include "kestrel/ground/hand_flight.hpp"

#include <algorithm>
#include <utility>

#include "kestrel/vehicle/limits.hpp"

namespace kestrel {

void HeldSticks::grip(double now_s) {
  is_gripped_ = true;
  heard_s_ = now_s;
  wanted_ = VelocityCommand::hover();
}

void HeldSticks::push(const VelocityCommand& wanted, double now_s) {
  if (!are_held(now_s)) return;
  if (!is_finite(wanted)) return let_go();
  wanted_ = wanted;
  heard_s_ = now_s;
}

void HeldSticks::let_go() { *this = HeldSticks{}; }

bool HeldSticks::are_held(double now_s) const {
  return is_gripped_ && now_s - heard_s_ <= kFresh_s;
}

VelocityCommand HeldSticks::wanted(double now_s) const {
  return are_held(now_s) ? wanted_ : VelocityCommand::hover();
}

Decision by_hand(Decision decision, const VelocityCommand& wanted, const DecisionState& before,
                 const CommandLimits& limits) {
  const std::optional<double> stamp_s = decision.next.stamp_s;
  decision = stopped(std::move(decision));
  if (!stamp_s || !before.stamp_s) return decision;  // nobody knows how much may have changed
  const double gone_s = std::min(*stamp_s - *before.stamp_s, HeldSticks::kFresh_s);
  decision.command = limited(before.sent, wanted, limits, gone_s);
  decision.next.sent = decision.command;
  decision.state = CommandState::Sticks;
  return decision;
}

Decision stopped(Decision decision) {
  const std::optional<double> stamp_s = decision.next.stamp_s;
  const LoopTiming timing = decision.next.timing;
  decision.command = VelocityCommand::hover();
  decision.state = CommandState::Hover;
  decision.next = DecisionState{};
  decision.next.stamp_s = stamp_s;
  decision.next.timing = timing;
  return decision;
}

}  // namespace kestrel
