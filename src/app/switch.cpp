#include "switch.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "kestrel/io/rotating_log.hpp"
#include "kestrel/link/real_time.hpp"
#include "kestrel/link/status_server.hpp"
#include "kestrel/link/switch_loop.hpp"
#include "kestrel/link/timestamp_store.hpp"

#include "interrupt.hpp"
#include "switch_file.hpp"
#include "switch_table.hpp"
#include "verbs.hpp"

namespace kestrel::app {
namespace {

constexpr double kPatience_s = 5;
constexpr double kNotePeriod_s = 0.1;

template <class Clock>
double seconds_of() {
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

SwitchTime time_now() {
  return {seconds_of<std::chrono::steady_clock>(), seconds_of<std::chrono::system_clock>()};
}

/// What signing has to remember over restarts, written by a thread of its own, since the disk may
/// be slow: the times given, of which none is given twice, and the newest that was accepted.
class SigningMemory {
 public:
  explicit SigningMemory(const std::filesystem::path& file)
      : accepted_file_(file.string() + ".accepted"),
        given_(file),
        floor_(mavlink::stored_signing_time(accepted_file_)),
        accepted_(floor_) {
    given_.extend(time_now().unix_s);
    keeper_ = std::thread([this] { keep(); });
  }
  ~SigningMemory() {
    ends_ = true;
    keeper_.join();
  }
  SigningMemory(const SigningMemory&) = delete;
  SigningMemory& operator=(const SigningMemory&) = delete;

  std::optional<std::uint64_t> next(double unix_s) { return given_.next(unix_s); }
  /// Signatures up to this were accepted before the start.
  std::uint64_t floor() const { return floor_; }
  void note_accepted(std::uint64_t newest) { accepted_ = std::max(accepted_.load(), newest); }

 private:
  void keep() {
    std::uint64_t kept = floor_;
    for (bool ends = false; !ends;) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      ends = ends_;
      const double unix_s = time_now().unix_s;
      if (given_.is_low(unix_s)) given_.extend(unix_s);
      const std::uint64_t newest = accepted_;
      if (newest > kept && mavlink::store_signing_time(accepted_file_, newest)) kept = newest;
    }
  }

  std::filesystem::path accepted_file_;
  mavlink::TimestampStore given_;
  std::uint64_t floor_;
  std::atomic<std::uint64_t> accepted_;
  std::atomic<bool> ends_{false};
  std::thread keeper_;
};

void tell_links(const SwitchReport& report) {
  for (const LinkReport& link : report.links) {
    fmt::print(stderr, "{}: {} at {}\n", link.name, name(link.role), to_string(link.place));
  }
}

/// Turns until Ctrl-C or SIGTERM; events go to the log, accepted signatures to the memory.
void turn_until_interrupted(SwitchLoop& loop, RotatingLog* log, SigningMemory* signing) {
  double next_note_s = 0;
  const auto tell = [&] {
    const SwitchTime time = time_now();
    for (const SwitchEvent& event : loop.take_events()) {
      if (log != nullptr) log->write(event_json(event, time.unix_s));
    }
    if (signing == nullptr || time.now_s < next_note_s) return;
    next_note_s = time.now_s + kNotePeriod_s;
    signing->note_accepted(loop.report().core.newest_signature);
  };
  while (!interrupted()) {
    loop.turn();
    tell();
  }
  loop.shutdown();
  next_note_s = 0;
  tell();
}

int serve(SwitchTask task) {
  std::unique_ptr<SigningMemory> signing;
  if (!task.signing_times.empty()) {
    signing = std::make_unique<SigningMemory>(task.signing_times);
    task.loop.core.signing_times = [&](double unix_s) { return signing->next(unix_s); };
    task.loop.core.signing_floor = signing->floor();
  }
  std::unique_ptr<RotatingLog> log;
  if (!task.log.empty()) log = std::make_unique<RotatingLog>(task.log, task.log_options);
  SwitchLoop loop(task.loop, time_now);
  tell_links(loop.report());
  if (task.real_time_priority > 0 && !run_in_real_time(task.real_time_priority)) {
    fmt::print(stderr,
               "real_time_priority: not permitted, so the switch shares the processors with all "
               "others (needs root, CAP_SYS_NICE or `ulimit -r`)\n");
  }
  fmt::print(stderr, "the switch runs; Ctrl-C sends zeros and ends it\n");
  turn_until_interrupted(loop, log.get(), signing.get());
  fmt::print("{}", switch_table(status_json(loop.report())));
  return kInterrupted;
}

int ask(const SwitchArguments& a) {
  const std::string json = ask_status(a.status, kPatience_s);
  fmt::print("{}", a.printed == Printed::Json ? json : switch_table(json));
  return 0;
}

}  // namespace

void add_switch(CLI::App& app, const std::shared_ptr<SwitchArguments>& a) {
  auto* verb = app.add_subcommand(
      "switch",
      "Route messages between flight control, vision and ground, and let nothing unsafe "
      "through; or ask the switch that runs");
  auto* what = verb->add_option_group("what");
  what->add_option("TASK", a->task, "Task file of a switch (tasks/switch.yaml)");
  what->add_option("--status", a->status,
                   "Ask the switch with this local socket (its task's key 'status')");
  what->require_option(1);
  verb->add_flag_callback(
      "--json", [a] { a->printed = Printed::Json; }, "Print the status as JSON");
}

int run(const SwitchArguments& a) {
  return a.task.empty() ? ask(a) : serve(read_switch_task(a.task));
}

}  // namespace kestrel::app
