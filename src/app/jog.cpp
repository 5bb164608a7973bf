#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <stdexcept>
#include <thread>

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "kestrel/link/autopilot_link.hpp"

#include "interrupt.hpp"
#include "verbs.hpp"

namespace kestrel::app {
namespace {

constexpr double kDegree = M_PI / 180;
constexpr double kFrame_s = 1 / 30.0;
constexpr double kSettle_s = 1;  // at zero, before and after each move

/// Sends the same command as if a camera had decided it, until `over`; false when it was
/// interrupted or control was lost.
bool send_until(AutopilotLink& link, const VelocityCommand& command,
                const std::function<bool()>& over) {
  while (!over()) {
    if (interrupted() || link.status().control == HandshakeState::Released ||
        link.status().control == HandshakeState::Refused) {
      return false;
    }
    link.send(command, link_clock_s());
    std::this_thread::sleep_for(std::chrono::duration<double>(kFrame_s));
  }
  return true;
}

bool send_for(AutopilotLink& link, const VelocityCommand& command, double seconds) {
  const double end_s = link_clock_s() + seconds;
  return send_until(link, command, [&] { return link_clock_s() >= end_s; });
}

/// True for an answer that begins with y. Zeros go on while the human thinks.
bool agreed(AutopilotLink& link, const std::string& question) {
  fmt::print(stderr, "{} [y/N] ", question);
  bool answered = false;
  std::string answer;
  send_until(link, VelocityCommand::hover(), [&] {
    pollfd in{STDIN_FILENO, POLLIN, 0};
    while (!answered && ::poll(&in, 1, 0) > 0) {
      char letter = 0;
      answered = ::read(STDIN_FILENO, &letter, 1) != 1 || letter == '\n';
      if (!answered) answer += letter;
    }
    return answered;
  });
  return answered && !answer.empty() && (answer[0] == 'y' || answer[0] == 'Y');
}

/// A human agrees before the mode of the vehicle is touched.
bool agreed_before_control(const JogArguments& a) {
  if (a.yes) return true;
  fmt::print(stderr, "take control of the vehicle at {}{}? [y/N] ", a.to,
             a.takeoff_m > 0 ? fmt::format(", arm it and take off to {} m", a.takeoff_m) : "");
  const int letter = std::getchar();
  for (int rest = letter; rest != '\n' && rest != EOF;) rest = std::getchar();
  return letter == 'y' || letter == 'Y';
}

struct Moment {
  VehicleMotion motion;
  double yaw = 0;
};

/// Where the vehicle is; waits up to a second for telemetry that tells.
std::optional<Moment> moment(AutopilotLink& link) {
  std::optional<Moment> found;
  const double end_s = link_clock_s() + 1;
  send_until(link, VelocityCommand::hover(), [&] {
    const double at_s = link_clock_s() - 0.05;  // within the telemetry that has arrived
    const auto motion = link.motion_at(at_s);
    const auto attitude = link.attitude_at_clock(at_s);
    if (motion && attitude) found = Moment{*motion, attitude->yaw};
    return found || link_clock_s() > end_s;
  });
  return found;
}

struct Jog {
  MotionAxis axis = MotionAxis::Forward;
  double rate = 0;
  std::string words;
  std::string verdict;
  Excursion done;
};

Jog jog(AutopilotLink& link, const JogArguments& a, MotionAxis axis) {
  Jog result;
  result.axis = axis;
  result.rate = axis == MotionAxis::Yaw ? a.yaw_rate_deg_s * kDegree : a.speed_m_s;
  result.verdict = "not tried";
  const std::string what = axis == MotionAxis::Yaw ? fmt::format("{} deg/s", a.yaw_rate_deg_s)
                                                   : fmt::format("{} m/s", a.speed_m_s);
  if (!a.yes &&
      !agreed(link, fmt::format("move {} by {} for {} s?", name(axis), what, a.seconds))) {
    result.words = fmt::format("{}: not tried", name(axis));
    return result;
  }
  send_for(link, VelocityCommand::hover(), kSettle_s);
  const auto before = moment(link);
  const bool moved = before && send_for(link, along(axis, result.rate), a.seconds);
  const bool stopped = send_for(link, VelocityCommand::hover(), kSettle_s);
  const auto after = moment(link);
  if (!moved || !stopped || !after) {
    result.words = fmt::format("{}: {}", name(axis),
                               before && after ? link.status().words : "no telemetry to judge by");
    return result;
  }
  result.done = excursion(before->motion, before->yaw, after->motion, after->yaw);
  result.verdict = name(judge(axis, result.rate, a.seconds, result.done));
  result.words = words(axis, result.rate, a.seconds, result.done);
  return result;
}

nlohmann::ordered_json as_json(const Jog& j) {
  return {{"axis", name(j.axis)},
          {"rate", j.rate},
          {"unit", j.axis == MotionAxis::Yaw ? "rad/s" : "m/s"},
          {"verdict", j.verdict},
          {"words", j.words},
          {"moved_forward_m", j.done.forward_m},
          {"moved_right_m", j.done.right_m},
          {"moved_down_m", j.done.down_m},
          {"turned_rad", j.done.yaw_rad}};
}

AutopilotOptions options_of(const JogArguments& a) {
  AutopilotOptions options;
  options.handshake.allow_arming = a.allow_arming;
  options.handshake.takeoff_m = a.takeoff_m;
  options.check();
  return options;
}

/// Waits until `state` holds; throws with the reason when it does not come to that.
void wait_for_control(AutopilotLink& link, const JogArguments& a) {
  const double end_s = link_clock_s() + a.wait_s + (a.takeoff_m > 0 ? 60 : 0);
  send_until(link, VelocityCommand::hover(), [&] {
    return link.status().control == HandshakeState::InControl || link_clock_s() > end_s;
  });
  const AdapterStatus status = link.status();
  if (status.control == HandshakeState::InControl || interrupted()) return;
  throw std::runtime_error(a.to + ": no control: " + status.words);
}

}  // namespace

int run(const JogArguments& a) {
  if (!agreed_before_control(a)) {
    fmt::print(stderr, "nothing was sent\n");
    return 1;
  }
  AutopilotLink link(parse_address(a.to), options_of(a), 0.0);
  wait_for_control(link, a);
  fmt::print(stderr, "{}\n", link.status().words);
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  bool good = true;
  for (const MotionAxis axis : a.axes) {
    if (interrupted() || link.status().control != HandshakeState::InControl) break;
    const Jog result = jog(link, a, axis);
    good = good && result.verdict == name(AxisVerdict::AsCommanded);
    all.push_back(as_json(result));
    if (!a.json) fmt::print("{:<12}  {}\n", result.verdict, result.words);
    std::fflush(stdout);
  }
  const AdapterStatus status = link.status();
  if (status.control != HandshakeState::InControl) fmt::print(stderr, "{}\n", status.words);
  link.stop();
  good = good && all.size() == a.axes.size();
  if (a.json) fmt::print("{}\n", nlohmann::ordered_json{{"good", good}, {"axes", all}}.dump(2));
  if (interrupted()) return kInterrupted;
  return good ? 0 : 1;
}

}  // namespace kestrel::app
