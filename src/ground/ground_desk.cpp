#include "kestrel/ground/ground_desk.hpp"

#include <utility>

namespace kestrel {
namespace {

Answer refused(const std::string& words) { return {Answer::Kind::Refused, words}; }

/// A client as a human reads it: the run's word is for the machine.
std::string page_of(const std::string& client) {
  return "page " + client.substr(client.rfind('-') + 1);
}

}  // namespace

GroundDesk::GroundDesk(const Task& task, CommandGate& gate, const std::string& run)
    : task_(task), most_gain_per_s_(task.servo.gain_per_s), gate_(gate), post_(run) {}

Reply GroundDesk::handle(const GroundCommand& command, double now_s) {
  Lock lock(mutex_);
  if (post_.relieve(now_s)) tell("the commander is silent: nobody has the command");
  if (is_stop(command.ask)) return {stop_or_start(command.ask), {}, {}, {}};
  if (command.ask == Ask::Join) return {{Answer::Kind::Done, "known"}, post_.join(now_s), {}, {}};
  if (const auto answer = post_.admit(command, now_s)) return {*answer, {}, {}, {}};
  return obey(command, now_s, lock);
}

Reply GroundDesk::obey(const GroundCommand& command, double now_s, Lock& lock) {
  Reply reply;
  const std::string before = post_.commander();
  if (command.ask == Ask::Take) {
    reply.answer = post_.take(command.client, now_s);
  } else if (!post_.commands(command.client)) {
    const bool is_sign = command.ask == Ask::Alive;
    reply.answer = is_sign ? Answer{} : refused("take the command first");
  } else if (command.ask == Ask::Release) {
    reply.answer = post_.release(command.client);
  } else if (command.ask == Ask::Start || command.ask == Ask::Reset) {
    reply.answer = stop_or_start(command.ask);
  } else if (command.ask == Ask::Gain) {
    reply.answer = set_gain(*command.gain_per_s);
  } else if (command.ask == Ask::HoldView) {
    reply.answer = hold_view();
  } else if (command.ask == Ask::Freeze) {
    reply.answer = freeze(*command.frame);
  } else if (command.ask == Ask::Examine) {
    reply = examine(*command.box, lock);
  } else if (command.ask == Ask::Use) {
    reply.answer = use(*command.width_m);
  }
  if (post_.commander() != before) {
    tell(post_.commander().empty() ? "nobody has the command"
                                   : page_of(post_.commander()) + " has the command");
  }
  return reply;
}

Answer GroundDesk::stop_or_start(Ask ask) {
  const ModeChange change = changed(mode_, ask);
  if (change.mode == FlightMode::Servo) {
    gate_.open();
  } else {
    gate_.close();
  }
  if (change.mode != mode_) tell(change.answer.words);
  mode_ = change.mode;
  return change.answer;
}

void GroundDesk::look_after(double now_s) {
  const Lock lock(mutex_);
  if (post_.relieve(now_s)) tell("the commander is silent: nobody has the command");
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
          {events_.begin(), events_.end()}};
}

void GroundDesk::tell(const std::string& words) {
  events_.push_back({++told_, views_.empty() ? 0 : views_.back()->row.stamp_s, words});
  if (events_.size() > kEvents) events_.pop_front();
}

Decision stopped(Decision decision) {
  const std::optional<double> stamp_s = decision.next.stamp_s;
  decision.command = VelocityCommand::hover();
  decision.state = CommandState::Hover;
  decision.next = DecisionState{};
  decision.next.stamp_s = stamp_s;
  return decision;
}

}  // namespace kestrel
