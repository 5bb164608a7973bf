#include "kestrel/ground/ground_desk.hpp"

#include <stdexcept>
#include <utility>

namespace kestrel {
namespace {

Answer refused(const std::string& words) { return {Answer::Kind::Refused, words}; }

/// A client as a human reads it: the run's word is for the machine.
std::string page_of(const std::string& client) {
  return "page " + client.substr(client.rfind('-') + 1);
}

bool is_sound(const Task& task) {
  try {
    task.check();
  } catch (const std::invalid_argument&) {
    return false;
  }
  return true;
}

/// The laws that have an answer where the task wants to be.
std::vector<std::string> laws_of(const Task& task) {
  std::vector<std::string> words;
  for (const Law law : all_laws()) {
    Task other = task;
    other.servo.law = law;
    if (is_sound(other)) words.emplace_back(name(law));
  }
  return words;
}

}  // namespace

GroundDesk::GroundDesk(const Task& task, CommandGate& gate, const std::string& run,
                       OperatorLink* by_hand)
    : task_(task),
      most_gain_per_s_(task.servo.gain_per_s),
      most_speed_(task.limits.speed),
      laws_(laws_of(task)),
      gate_(gate),
      by_hand_(by_hand),
      post_(run) {}

Reply GroundDesk::handle(const GroundCommand& command, double now_s) {
  Lock lock(mutex_);
  notice_silence(now_s);
  if (is_stop(command.ask)) return {stop_or_start(command.ask), {}, {}, {}};
  if (command.ask == Ask::Join) return {{Answer::Kind::Done, "known"}, post_.join(now_s), {}, {}};
  if (const auto answer = post_.admit(command, now_s)) return {*answer, {}, {}, {}};
  return obey(command, now_s, lock);
}

Reply GroundDesk::obey(const GroundCommand& command, double now_s, Lock& lock) {
  const std::string before = post_.commander();
  Reply reply;
  if (command.ask == Ask::Take) {
    reply.answer = post_.take(command.client, now_s);
  } else if (post_.commands(command.client)) {
    reply = done_for_commander(command, now_s, lock);
  } else {
    const bool is_sign = command.ask == Ask::Alive;
    reply.answer = is_sign ? Answer{} : refused("take the command first");
  }
  if (post_.commander() == before) return reply;
  tell(post_.commander().empty() ? "nobody has the command"
                                 : page_of(post_.commander()) + " has the command");
  if (mode_ == FlightMode::Sticks) stop_or_start(Ask::Hover);  // another hand must take them anew
  return reply;
}

Reply GroundDesk::done_for_commander(const GroundCommand& command, double now_s, Lock& lock) {
  const auto only = [](const Answer& answer) { return Reply{answer, {}, {}, {}}; };
  switch (command.ask) {
    case Ask::Release:
      return only(post_.release(command.client));
    case Ask::Start:
    case Ask::Reset:
      return only(stop_or_start(command.ask));
    case Ask::Grip: {
      const Answer answer = stop_or_start(Ask::Grip);
      if (answer.kind == Answer::Kind::Done) sticks_.grip(now_s);
      return only(answer);
    }
    case Ask::Sticks:
      return only(move_sticks(*command.velocity, now_s));
    case Ask::Gain:
      return only(set_gain(*command.gain_per_s));
    case Ask::Law:
      return only(set_law(*command.law));
    case Ask::Limits:
      return only(set_limits(*command.velocity));
    case Ask::Goal:
      return only(set_goal(*command.goal));
    case Ask::HoldView:
      return only(hold_view());
    case Ask::Freeze:
      return only(freeze(*command.frame));
    case Ask::Examine:
      return examine(*command.box, lock);
    case Ask::Use:
      return only(use(*command.width_m));
    default:
      return {};
  }
}

/// A value that is late moves nothing: only a hand that takes the sticks anew does.
Answer GroundDesk::move_sticks(const VelocityCommand& wanted, double now_s) {
  if (mode_ != FlightMode::Sticks) return refused("take the sticks first");
  sticks_.push(wanted, now_s);
  return {};
}

void GroundDesk::notice_silence(double now_s) {
  if (post_.relieve(now_s)) tell("the commander is silent: nobody has the command");
  if (mode_ != FlightMode::Sticks) return;
  if (sticks_.are_held(now_s) && !post_.commander().empty()) return;
  tell("nobody holds the sticks");
  stop_or_start(Ask::Hover);
}

Answer GroundDesk::stop_or_start(Ask ask) {
  if (const std::string why = refused_by_switch(ask); !why.empty()) return refused(why);
  ModeChange change = changed(mode_, ask);
  if (resets_switch_only(ask)) {
    change = {FlightMode::Hover, {Answer::Kind::Done, "reset of the switch: hover until start"}};
  }
  if (change.mode != FlightMode::Sticks) sticks_.let_go();
  if (change.mode == FlightMode::Servo || change.mode == FlightMode::Sticks) {
    gate_.open();
  } else {
    gate_.close();
  }
  if (change.answer.kind == Answer::Kind::Done) tell_switch(ask, mode_);
  if (change.mode != mode_) tell(change.answer.words);
  mode_ = change.mode;
  return change.answer;
}

void GroundDesk::look_after(double now_s) {
  const Lock lock(mutex_);
  hear_switch();
  notice_silence(now_s);
}

Decision GroundDesk::steered(Decision decision, const DecisionState& before, double now_s) {
  const Lock lock(mutex_);
  if (mode_ == FlightMode::Servo) return decision;
  const bool by_a_hand = mode_ == FlightMode::Sticks && sticks_.are_held(now_s);
  if (!by_a_hand) return stopped(std::move(decision));
  gate_.fork(law_flew_ ? decision.command : VelocityCommand::hover());
  return by_hand(std::move(decision), sticks_.wanted(now_s), before, task_.limits);
}

void GroundDesk::show(std::shared_ptr<const GroundView> view) {
  std::shared_ptr<const GroundView> oldest;  // ends after the lock
  const Lock lock(mutex_);
  views_.push_back(std::move(view));
  if (views_.size() <= kKeptViews) return;
  oldest = std::move(views_.front());
  views_.pop_front();
}

std::optional<Course> GroundDesk::course() {
  const Lock lock(mutex_);
  return std::exchange(course_, std::nullopt);
}

FlightMode GroundDesk::mode() const {
  const Lock lock(mutex_);
  return mode_;
}

DeskStatus GroundDesk::status() const {
  const Lock lock(mutex_);
  return {mode_,
          post_.commander(),
          post_.asker(),
          task_.servo.gain_per_s,
          most_gain_per_s_,
          task_.limits,
          most_speed_,
          name(task_.servo.law),
          laws_,
          gate_.counts(),
          gate_.failures(),
          {events_.begin(), events_.end()},
          way()};
}

void GroundDesk::tell(const std::string& words) {
  events_.push_back({++told_, views_.empty() ? 0 : views_.back()->row.stamp_s, words});
  if (events_.size() > kEvents) events_.pop_front();
}

}  // namespace kestrel
