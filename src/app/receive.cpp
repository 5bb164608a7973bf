#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "kestrel/io/csv.hpp"
#include "kestrel/link/command_receiver.hpp"

#include "command_csv.hpp"
#include "interrupt.hpp"
#include "stand_in.hpp"
#include "verbs.hpp"

namespace kestrel::app {
namespace {

constexpr double kPollSeconds = 0.1;

std::string text_line(const ReceivedCommand& c) {
  return fmt::format(
      "{:9.3f} s  forward {:+.3f}  right {:+.3f}  down {:+.3f} m/s  yaw {:+.2f} deg/s",
      c.time_boot_ms / 1000.0, c.command.forward_m_s, c.command.right_m_s, c.command.down_m_s,
      c.command.yaw_rate_rad_s * 180 / M_PI);
}

bool enough(const ReceiveArguments& a, double elapsed_s, const ReceiverCounts& counts) {
  return interrupted() || (a.duration_s && elapsed_s >= *a.duration_s) ||
         (a.count && counts.commands >= *a.count);
}

/// Polls until it is enough; the receiver is a CommandReceiver or a StandIn.
template <class Receiver, class Tell>
void listen(const ReceiveArguments& a, Receiver& receiver, const Tell& tell) {
  std::unique_ptr<LineFile> log;
  if (!a.log.empty()) {
    log = std::make_unique<LineFile>(a.log);
    log->write(command_columns());
  }
  fmt::print(stderr, "listening on {}; Ctrl-C ends\n", to_string(receiver.local()));
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  while (!enough(a, elapsed(), receiver.counts())) {
    for (const ReceivedCommand& command : receiver.poll(kPollSeconds)) {
      if (log) log->write(command_line(command));
      if (!a.quiet) fmt::print("{}\n", text_line(command));
    }
    tell();
    std::fflush(stdout);
  }
}

int receive_as_autopilot(const ReceiveArguments& a) {
  AutopilotModelOptions rules;
  rules.autopilot = *a.autopilot;
  rules.starts_armed = a.starts_in_air;
  StandIn autopilot(parse_address(a.address), rules);
  listen(a, autopilot, [&] {
    for (const std::string& line : autopilot.take_events()) fmt::print("{}\n", line);
  });
  Summary summary = receiver_summary(autopilot.counts());
  autopilot.report(summary);
  fmt::print("{}", text_table(summary));
  return interrupted() ? kInterrupted : 0;
}

}  // namespace

int run(const ReceiveArguments& a) {
  if (a.autopilot) return receive_as_autopilot(a);
  CommandReceiver receiver(parse_address(a.address));
  listen(a, receiver, [] {});
  fmt::print("{}", text_table(receiver_summary(receiver.counts())));
  return interrupted() ? kInterrupted : 0;
}

}  // namespace kestrel::app
