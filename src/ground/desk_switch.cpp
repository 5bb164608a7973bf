// What GroundDesk says to a switch on the operator's own link, and what it makes of the answers.
#include <utility>

#include "kestrel/ground/ground_desk.hpp"

namespace kestrel {
namespace {

bool is_stopped(const OperatorStatus& status) {
  return status.is_heard && status.control && status.control->state == ControlState::Stopped;
}

}  // namespace

/// Why the switch stands in the way; empty when it does not.
std::string GroundDesk::refused_by_switch(Ask ask) const {
  if (by_hand_ == nullptr || (ask != Ask::Start && ask != Ask::Grip)) return {};
  const OperatorStatus status = by_hand_->status();
  if (is_stopped(status)) {
    return std::string("the switch is under its emergency stop: reset first, then ") +
           (ask == Ask::Grip ? "take the sticks" : "start");
  }
  if (ask == Ask::Start || status.is_heard) return {};
  return "the switch is not heard on the ground's own link: no hand can take over";
}

/// An emergency stop that is not this page's is ended by it as well, and nothing set going by that.
bool GroundDesk::resets_switch_only(Ask ask) const {
  return ask == Ask::Reset && by_hand_ != nullptr && mode_ != FlightMode::Aborted &&
         is_stopped(by_hand_->status());
}

/// After the gate was closed or opened: no command of a hand follows the zero.
void GroundDesk::tell_switch(Ask ask, FlightMode before) {
  if (by_hand_ == nullptr) return;
  switch (ask) {
    case Ask::Abort:
      return by_hand_->stop();
    case Ask::Reset:
      return by_hand_->reset();
    case Ask::Hover:
      return before == FlightMode::Sticks ? by_hand_->release() : by_hand_->zero();
    case Ask::Grip:
      if (before != FlightMode::Sticks) law_flew_ = before == FlightMode::Servo;
      return by_hand_->take_over();
    default:
      return;
  }
}

/// Doubt means hover: a hand flies as long as the switch is heard and does not refuse it.
void GroundDesk::hear_switch() {
  if (by_hand_ == nullptr) return;
  by_hand_->look_after();
  for (const std::string& words : by_hand_->take_words()) tell(words);
  const OperatorStatus status = by_hand_->status();
  if (mode_ == FlightMode::Servo && is_stopped(status)) {
    tell(
        "the switch was stopped: the law waits for Start");  // whoever resets it sets nothing going
    stop_or_start(Ask::Hover);
  }
  if (mode_ != FlightMode::Sticks) return;
  // Granted, and ended by somebody else: only its priority would be left of the take-over.
  const bool is_lost =
      status.open.empty() && status.control && status.control->state != ControlState::TakenOver;
  if (status.holds && status.is_heard && !is_stopped(status) && !is_lost) return;
  tell(status.is_heard ? "the switch does not let the hand fly" : "the switch is not heard");
  stop_or_start(Ask::Hover);
}

HandWay GroundDesk::way() const {
  if (by_hand_ == nullptr) return {"A hand's velocities go the way of the law's.", false, false};
  const OperatorStatus status = by_hand_->status();
  const std::string hand = mode_ == FlightMode::Sticks
                               ? "The hand flies on the ground's own link. "
                               : "A hand takes over on the ground's own link. ";
  return {hand + words(status), true, is_stopped(status)};
}

}  // namespace kestrel
