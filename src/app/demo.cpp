#include <algorithm>
#include <atomic>
#include <thread>

#include <fmt/format.h>

#include "kestrel/io/csv.hpp"
#include "kestrel/io/run_folder.hpp"
#include "kestrel/link/command_receiver.hpp"

#include "command_csv.hpp"
#include "interrupt.hpp"
#include "servo.hpp"
#include "simulate.hpp"
#include "verbs.hpp"

namespace kestrel::app {
namespace {

/// A receiver on loopback that counts and logs in a thread of its own, as a flight controller
/// would listen.
class LoopbackReceiver {
 public:
  explicit LoopbackReceiver(const std::filesystem::path& log)
      : receiver_(parse_address("udp://127.0.0.1:0")), log_(log) {
    log_.write(command_columns());
    thread_ = std::thread([this] { listen(); });
  }
  ~LoopbackReceiver() { stop(); }
  LoopbackReceiver(const LoopbackReceiver&) = delete;
  LoopbackReceiver& operator=(const LoopbackReceiver&) = delete;

  std::string address() const { return to_string(receiver_.local()); }

  /// Waits until nothing more arrives and returns the counts.
  ReceiverCounts stop() {
    stopping_ = true;
    if (thread_.joinable()) thread_.join();
    return receiver_.counts();
  }

 private:
  void listen() {
    constexpr double kPollSeconds = 0.05;
    while (true) {
      const bool last_round = stopping_;
      const auto commands = receiver_.poll(kPollSeconds);
      for (const ReceivedCommand& command : commands) log_.write(command_line(command));
      if (last_round && commands.empty()) return;
    }
  }

  CommandReceiver receiver_;
  LineFile log_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

/// Takes over the named items of a run's summary.
void take(Summary& into, const Summary& from, const std::vector<std::string>& names) {
  for (const SummaryItem& item : from.items()) {
    if (std::find(names.begin(), names.end(), item.name) != names.end()) into.add(item);
  }
}

/// Summary and page of the whole job.
int finish(const std::filesystem::path& folder, const Summary& summary, int exit_code) {
  write_summary(folder / "summary.json", summary);
  Report report;
  report.title = "Kestrel: the main job";
  report.what =
      "A recorded sequence through the whole chain, its commands sent over UDP to a receiver, and "
      "the built-in helicopter flown to a hover in front of a wall.";
  report.summary = summary;
  report.files = {{"sequence/report.html", "report of the recorded sequence"},
                  {"flight/report.html", "report of the flight"},
                  {"commands.csv", "the commands as the receiver got them"},
                  {"summary.json", "the table above, for programs"}};
  write_text(folder / "report.html", report_html(report));
  print_result({folder, summary, exit_code});
  return exit_code;
}

}  // namespace

int run(const DemoArguments& a) {
  const std::filesystem::path folder =
      create_run_folder(a.output.empty() ? std::filesystem::path("runs/demo") : a.output);
  LoopbackReceiver receiver(folder / "commands.csv");
  fmt::print(stderr, "1 of 2: a recorded sequence, commands to {}\n", receiver.address());
  ServoArguments tracked;
  tracked.task = a.tasks / "comic.yaml";
  tracked.sink = receiver.address();
  tracked.run.output = folder / "sequence";
  const RunResult sequence = servo(tracked);
  const ReceiverCounts counts = receiver.stop();
  Summary summary;
  summary.begin_section("recorded sequence");
  take(summary, sequence.summary, {"frames", "found", "servoed", "chain time, median"});
  summary.add("commands received", std::int64_t(counts.commands));
  summary.add("heartbeats received", std::int64_t(counts.heartbeats));
  int code = sequence.exit_code;
  if (!interrupted()) {
    fmt::print(stderr, "2 of 2: the built-in helicopter\n");
    SimulateArguments flown;
    flown.task = a.tasks / "hover.yaml";
    flown.run.output = folder / "flight";
    const RunResult flight = simulate(flown);
    summary.begin_section("flight");
    take(summary, flight.summary,
         {"result", "settled after", "final position error", "final heading error", "target seen"});
    code = std::max(code, flight.exit_code);
  }
  return finish(folder, summary, code);
}

}  // namespace kestrel::app
