#include "kestrel/link/switch_operator.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace kestrel {
namespace {

constexpr RequestOptions kRequests{0.1, 4, 1};  // half a second of a hand at the sticks
constexpr std::size_t kMaxWords = 50;           // nobody may ask

const char* verb(SwitchControl what) {
  switch (what) {
    case SwitchControl::TakeOver:
      return "take-over";
    case SwitchControl::Lock:
      return "lock";
    case SwitchControl::Release:
      return "release";
    case SwitchControl::EmergencyStop:
      return "emergency stop";
    case SwitchControl::Reset:
      return "reset";
  }
  return "request";
}

/// Given up when nobody answers: what they would set going is not to begin late.
bool is_given_up(SwitchControl what) {
  return what == SwitchControl::TakeOver || what == SwitchControl::Reset;
}

}  // namespace

std::string words(const OperatorStatus& status) {
  std::string all = !status.is_heard ? "The switch is not heard"
                    : status.control ? "The switch: " + words(*status.control)
                                     : "The switch is heard, but does not say who commands";
  if (!status.open.empty()) all += "; no answer yet to: " + status.open;
  return all + '.';
}

void SwitchOperator::ask(SwitchControl what) {
  mavlink::CommandLong command;
  command.command = std::uint16_t(what);
  command.target_system = self_.system_id;
  command.target_component = self_.component_id;
  open_.push_back({what, CommandRequest(command, kRequests), std::nullopt});
}

void SwitchOperator::drop(SwitchControl what) {
  open_.erase(std::remove_if(open_.begin(), open_.end(),
                             [&](const Open& open) { return open.what == what; }),
              open_.end());
}

bool SwitchOperator::has_open(SwitchControl what) const {
  return std::any_of(open_.begin(), open_.end(),
                     [&](const Open& open) { return open.what == what; });
}

void SwitchOperator::take_over() {
  drop(SwitchControl::TakeOver);
  drop(SwitchControl::Release);
  ask(SwitchControl::TakeOver);
  holds_ = owes_release_ = true;
}

void SwitchOperator::release() {
  if (!holds_) return;
  holds_ = false;
  drop(SwitchControl::TakeOver);
  ask(SwitchControl::Release);
}

void SwitchOperator::stop() {
  open_.clear();
  ask(SwitchControl::EmergencyStop);
  holds_ = false;
  if (owes_release_) ask(SwitchControl::Release);  // the stop outlives it
}

void SwitchOperator::reset() {
  drop(SwitchControl::EmergencyStop);
  drop(SwitchControl::Reset);
  ask(SwitchControl::Reset);
  // Before a release that nobody answers: late it would end a stop that came meanwhile.
  std::rotate(open_.begin(), std::prev(open_.end()), open_.end());
}

std::optional<mavlink::CommandLong> SwitchOperator::due(double now_s) {
  while (!open_.empty()) {
    Open& first = open_.front();
    const auto command = first.request.due(now_s);
    if (command && !first.first_s) first.first_s = now_s;
    if (first.request.state() != RequestState::Refused) return command;
    settle(now_s);
  }
  return std::nullopt;
}

void SwitchOperator::hear(const mavlink::Packet& packet, double now_s) {
  if (packet.envelope.system_id != self_.system_id ||
      packet.envelope.component_id != self_.component_id) {
    return;
  }
  if (const auto* beat = std::get_if<mavlink::Heartbeat>(&packet.message)) {
    heard_s_ = now_s;
    control_ = control_word(beat->custom_mode);
  }
  const auto* ack = std::get_if<mavlink::CommandAck>(&packet.message);
  if (ack == nullptr) return;
  heard_s_ = now_s;
  if (const auto word = control_word(std::uint32_t(ack->result_param2))) control_ = word;
  if (open_.empty()) return;
  open_.front().request.acknowledge(*ack, now_s);
  if (open_.front().request.state() != RequestState::Open) settle(now_s);
}

/// The first has come to its end.
void SwitchOperator::settle(double now_s) {
  const Open first = std::move(open_.front());
  open_.pop_front();
  if (first.request.state() == RequestState::Accepted) return accepted(first, now_s);
  refused(first);
}

void SwitchOperator::accepted(const Open& open, double now_s) {
  is_unanswered_ = false;
  if (open.what == SwitchControl::Release) owes_release_ = false;
  const long ms = std::lround((now_s - open.first_s.value_or(now_s)) * 1e3);
  tell(std::string(verb(open.what)) + " granted after " + std::to_string(ms) + " ms" +
       (control_ ? "; " + words(*control_) : ""));
}

void SwitchOperator::refused(const Open& open) {
  const bool is_silence = open.request.words().find("no answer") != std::string::npos;
  if (open.what == SwitchControl::TakeOver) holds_ = false;
  if (!is_silence) {
    owes_release_ = false;  // it takes no such words from here
    return tell(std::string(verb(open.what)) + " refused: " + open.request.words() +
                " (is this a link of role ground?)");
  }
  const bool goes_on = !is_given_up(open.what);
  if (goes_on) {
    ask(open.what);
    std::rotate(open_.begin(), std::prev(open_.end()), open_.end());  // still the first
    if (std::exchange(is_unanswered_, true)) return;
  }
  if (open.what == SwitchControl::TakeOver) ask(SwitchControl::Release);  // it may have been heard
  tell(std::string(verb(open.what)) + ": no answer" + (goes_on ? "; it is asked again" : ""));
}

OperatorStatus SwitchOperator::status(double now_s) const {
  OperatorStatus status;
  status.is_heard = heard_s_ && now_s - *heard_s_ <= kSilence_s;
  status.control = control_;
  status.holds = holds_;
  if (!open_.empty()) status.open = verb(open_.front().what);
  return status;
}

void SwitchOperator::tell(const std::string& words) {
  if (words_.size() < kMaxWords) words_.push_back("the switch: " + words);
}

std::vector<std::string> SwitchOperator::take_words() { return std::exchange(words_, {}); }

}  // namespace kestrel
