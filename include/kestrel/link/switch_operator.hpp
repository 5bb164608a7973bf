#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "kestrel/link/command_desk.hpp"
#include "kestrel/link/command_request.hpp"
#include "kestrel/link/control_word.hpp"
#include "kestrel/link/frame.hpp"

namespace kestrel {

/// How an operator stands with the switch.
struct OperatorStatus {
  bool is_heard = false;               // the switch was, within SwitchOperator::kSilence_s
  std::optional<ControlWord> control;  // what it said last
  bool holds = false;  // a take-over was asked for, and neither refused nor released
  std::string open;    // what was asked for and is not answered yet; empty: nothing
};

/// For a human, one sentence.
std::string words(const OperatorStatus& status);

/// What an operator asks of a switch over a link of role `ground`, each until it is answered:
/// take-over, release, emergency stop, reset (SwitchControl). The newest word counts: a stop ends
/// all else that is open, a take-over a release. A stop and a release are asked for until they are
/// answered, however long that takes; a take-over and a reset are given up after half a second. No
/// socket, no clock: times are of one of the caller's, s.
class SwitchOperator {
 public:
  /// The heartbeat of a switch comes once a second; two may be lost.
  static constexpr double kSilence_s = 3;

  /// self: the ids of the switch.
  explicit SwitchOperator(const Recipient& self) : self_(self) {}

  void take_over();
  void release();  // nothing when nothing was taken over
  void stop();
  void reset();

  /// The request that is to be sent now; to be asked until it is empty.
  std::optional<mavlink::CommandLong> due(double now_s);

  /// A message that came over the link; what is not the switch's is passed over.
  void hear(const mavlink::Packet& packet, double now_s);

  OperatorStatus status(double now_s) const;

  /// True while a release or a stop has not been answered.
  bool owes() const { return owes_release_ || has_open(SwitchControl::EmergencyStop); }

  /// What the switch answered since the last call, for a human.
  std::vector<std::string> take_words();

 private:
  struct Open {
    SwitchControl what;
    CommandRequest request;
    std::optional<double> first_s;  // when it was sent first
  };

  void ask(SwitchControl what);
  void drop(SwitchControl what);
  bool has_open(SwitchControl what) const;
  void settle(double now_s);
  void accepted(const Open& open, double now_s);
  void refused(const Open& open);
  void tell(const std::string& words);

  Recipient self_;
  std::deque<Open> open_;  // the first is being asked
  std::optional<ControlWord> control_;
  std::optional<double> heard_s_;
  bool holds_ = false;
  bool owes_release_ = false;
  bool is_unanswered_ = false;  // and that was told
  std::vector<std::string> words_;
};

}  // namespace kestrel
