#pragma once

#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "kestrel/ground/command_gate.hpp"
#include "kestrel/ground/command_post.hpp"
#include "kestrel/ground/flight_mode.hpp"
#include "kestrel/ground/ground_view.hpp"
#include "kestrel/ground/hand_flight.hpp"
#include "kestrel/ground/template_verdict.hpp"
#include "kestrel/link/operator_link.hpp"
#include "kestrel/loop/task.hpp"
#include "kestrel/vision/tracker.hpp"

namespace kestrel {

/// What the chain is to do from its next frame on.
struct Course {
  Task task;
  std::optional<Tracker> tracker;  // of a new template; empty: the one there is
};

/// What a command is answered.
struct Reply {
  Answer answer;
  std::string client;  // of "join"
  std::optional<TemplateVerdict> verdict;
  std::optional<double> width_m;  // likely width of the template examined
};

/// Something an operator did, or that happened to one.
struct GroundEvent {
  std::uint64_t number = 0;  // counts from 1
  double stamp_s = 0;        // of the newest frame
  std::string words;
};

/// By which way an operator's own velocities go, and what is at its other end.
struct HandWay {
  std::string words;     // for a human
  bool is_own = false;   // not the law's
  bool stopped = false;  // the switch is under its emergency stop
};

/// How things stand at the desk.
struct DeskStatus {
  FlightMode mode = FlightMode::Hover;
  std::string commander;  // client; empty: nobody
  std::string asker;
  double gain_per_s = 0;
  double most_gain_per_s = 0;
  CommandLimits limits;
  VelocityCommand most_speed;  // the task's own
  std::string law;
  std::vector<std::string> laws;  // that may be asked for
  GateCounts sent;
  long failures = 0;                // of the sink: commands that did not leave
  std::vector<GroundEvent> events;  // the last kEvents, oldest first
  HandWay way;
};

/// Where the commands of all viewers meet the chain: what is allowed is done, and all is answered.
/// The loop's thread shows frames and takes the course; any thread brings commands. No clock: times
/// are of the caller's, s. Nobody waits long: learning a template is done outside the lock.
///
/// The chain starts in hover. Abort and hover are anybody's at any time; all else is the
/// commander's, one at a time. A commander who falls silent loses the command; the chain goes on.
/// Sticks that are not heard of, or whose hand loses the command, are let go: hover.
///
/// With a link of the operator's own to a switch, a hand takes over there, its velocities go by
/// that link and the law's by its own; who lets go releases, and hovers there until Start. Hover is
/// a zero on both, Abort the switch's emergency stop besides, Reset its end. A hand that the switch
/// does not hear, or does not grant, flies nothing: hover.
class GroundDesk {
 public:
  static constexpr std::size_t kEvents = 50;
  /// Frames of which one can be frozen: a second of them, since a viewer is behind.
  static constexpr std::size_t kKeptViews = 30;

  /// run: see CommandPost. The task's gain and velocities are the most that can be asked for, and
  /// its laws those that have an answer at its goal. The gate is opened by start and by taking the
  /// sticks, closed by abort and hover, at once; it must outlive the desk, and
  /// so must by_hand, which is the gate's as well. Null: a hand's velocities go the law's way.
  GroundDesk(const Task& task, CommandGate& gate, const std::string& run,
             OperatorLink* by_hand = nullptr);

  /// Answers a command and does what it asks for, now or with the next frame.
  Reply handle(const GroundCommand& command, double now_s);

  /// Takes the command from a commander who has fallen silent, and lets go of sticks that nobody
  /// holds: to be called as often as that is to be noticed.
  void look_after(double now_s);

  /// The decision of a frame as it may be flown: the law's, a hand's, or none. before: the chain's
  /// state at that frame.
  Decision steered(Decision decision, const DecisionState& before, double now_s);

  void show(std::shared_ptr<const GroundView> view);

  /// What has changed since it was asked last; empty: nothing.
  std::optional<Course> course();

  FlightMode mode() const;
  DeskStatus status() const;

 private:
  struct Candidate {
    Tracker tracker;
    PixelBox box;
    std::shared_ptr<const GroundView> view;
  };
  using Lock = std::unique_lock<std::mutex>;

  Answer stop_or_start(Ask ask);
  Reply obey(const GroundCommand& command, double now_s, Lock& lock);
  Reply done_for_commander(const GroundCommand& command, double now_s, Lock& lock);
  Answer move_sticks(const VelocityCommand& wanted, double now_s);
  void notice_silence(double now_s);
  std::string refused_by_switch(Ask ask) const;
  bool resets_switch_only(Ask ask) const;
  void tell_switch(Ask ask, FlightMode before);
  void hear_switch();
  HandWay way() const;
  Answer set_law(const std::string& word);
  Answer set_limits(const VelocityCommand& speed);
  Answer set_goal(const VehiclePlace& place);
  Answer set_gain(double gain_per_s);
  Answer hold_view();
  Answer freeze(std::int64_t frame);
  Reply examine(const PixelBox& box, Lock& lock);
  Answer use(double width_m);
  Answer steer(const Task& task, std::optional<Tracker> tracker, const std::string& done);
  double likely_width_m(const PixelBox& box, const GroundView& view) const;
  void tell(const std::string& words);

  mutable std::mutex mutex_;
  Task task_;
  const double most_gain_per_s_;
  const VelocityCommand most_speed_;
  const std::vector<std::string> laws_;
  CommandGate& gate_;
  OperatorLink* by_hand_;
  bool law_flew_ = false;  // when the hand took over: then it goes on beside it
  CommandPost post_;
  FlightMode mode_ = FlightMode::Hover;
  HeldSticks sticks_;
  std::deque<std::shared_ptr<const GroundView>> views_;
  std::shared_ptr<const GroundView> frozen_;
  std::optional<Candidate> candidate_;
  std::optional<Course> course_;
  std::deque<GroundEvent> events_;
  std::uint64_t told_ = 0;
};

}  // namespace kestrel
