// The command line of `kestrel simulate`.
#include <charconv>
#include <map>
#include <memory>

#include <CLI/CLI.hpp>

#include "arguments.hpp"

namespace kestrel::app {
namespace {

SeedRange seed_range(const std::string& text) {
  SeedRange range;
  const auto* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, range.first);
  const bool has_last = first.ec == std::errc() && first.ptr != end && *first.ptr == '-';
  const auto last = has_last ? std::from_chars(first.ptr + 1, end, range.last) : first;
  if (!has_last || last.ec != std::errc() || last.ptr != end || range.first < 0 ||
      range.last < range.first) {
    throw CLI::ValidationError("--seeds", "'" + text + "': write FIRST-LAST, for instance 1-20");
  }
  return range;
}

/// The options of a simulation beside other programs; gives the flag that asks for it.
CLI::Option* add_real_time(CLI::App& verb, const std::shared_ptr<SimulateArguments>& a) {
  const auto r = std::make_shared<RealTimeArguments>();
  auto* flag = verb.add_flag(
      "--real-time",
      "Fly by the clock as a vehicle and a camera for other programs (kestrel servo, switch), "
      "until Ctrl-C or --duration");
  const auto asked = [&](CLI::Option* option) { return option->needs(flag); };
  asked(verb.add_option("--vehicle-port", r->vehicle_port,
                        "UDP port of the vehicle on 127.0.0.1; 0: any (default 14550)"));
  asked(verb.add_option("--frames", r->frames,
                        "Where frames are served: HOST:PORT, or the path of a local socket "
                        "(default 127.0.0.1:14570)"));
  asked(verb.add_option("--vehicle", r->vehicle,
                        "Render from the pose of another vehicle: mavlink:udp:HOST:PORT"));
  asked(verb.add_option("--vehicle-origin", r->origin_ned_m,
                        "Where the local frame of --vehicle begins: north east down, m (default: "
                        "on the ground below the task's start)")
            ->expected(3)
            ->delimiter(','));
  asked(verb.add_option("--autopilot", r->autopilot,
                        "Whose rules the built-in vehicle keeps: ardupilot or px4 (default "
                        "ardupilot)")
            ->transform(CLI::CheckedTransformer(
                std::map<std::string, Autopilot>{{"ardupilot", Autopilot::ArduPilot},
                                                 {"px4", Autopilot::Px4}},
                CLI::ignore_case)));
  asked(verb.add_flag_callback(
      "--on-ground", [r] { r->starts_in_air = false; },
      "Start disarmed on the ground (default: armed, at the task's start)"));
  verb.callback([a, r, flag] {
    if (flag->count() > 0) a->real_time = *r;
  });
  return flag;
}

}  // namespace

void add_simulate_options(CLI::App& verb, const std::shared_ptr<SimulateArguments>& a) {
  verb.add_option("TASK", a->task, "Task file with a section 'simulation'")->required();
  verb.add_option("--duration", a->duration_s, "Longest flight, s (default: the task's)");
  auto* seed = verb.add_option("--seed", a->seed,
                               "Seed of start, noise, wind and sensors (default: the task's)");
  auto* seed_range_option = verb.add_option_function<std::string>(
      "--seeds", [a](const std::string& text) { a->seeds = seed_range(text); },
      "Fly once for each seed, FIRST-LAST, and make a table");
  seed_range_option->excludes(seed);
  auto* sink = verb.add_option(
      "--sink", a->sink,
      "Send the commands there too: autopilot:udp://HOST:PORT (the flight then goes in "
      "real time) or udp://HOST:PORT");
  verb.add_option("--record", a->record,
                  "Folder for the camera's frames as a sequence with truth, for `evaluate` "
                  "(default: they are not kept)");
  add_real_time(verb, a)->excludes(seed_range_option)->excludes(sink);
}

}  // namespace kestrel::app
