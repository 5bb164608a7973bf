#include "sinks.hpp"

#include <cmath>
#include <deque>
#include <mutex>
#include <stdexcept>

#include <fmt/format.h>

#include "kestrel/link/autopilot_link.hpp"
#include "kestrel/link/command_link.hpp"

namespace kestrel::app {
namespace {

class NoSink final : public CommandSink {
 public:
  void send(const VelocityCommand&, double) noexcept override {}
  long failures() const override { return 0; }
};

/// A link that remembers when its commands left.
class TimedLink final : public CommandSink {
 public:
  TimedLink(const Address& to, std::optional<double> stamp_origin_s)
      : link_(to), stamp_origin_s_(stamp_origin_s) {}
  void send(const VelocityCommand& command, double stamp_s) noexcept override {
    const std::lock_guard<std::mutex> lock(mutex_);  // an operator's stop comes from its own thread
    link_.send(command, stamp_s);
    const double sent_s = link_clock_s();
    if (stamp_origin_s_) stamp_s += *stamp_origin_s_;
    times_.push_back({sent_s, stamp_origin_s_ ? std::optional(stamp_s) : std::nullopt});
    if (times_.size() > kMaxTimes) times_.pop_front();
  }
  long failures() const override {
    const std::lock_guard<std::mutex> lock(mutex_);
    return link_.failures();
  }
  std::vector<WireTime> take_times() {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::vector<WireTime> times(times_.begin(), times_.end());
    times_.clear();
    return times;
  }

 private:
  static constexpr std::size_t kMaxTimes = 4096;  // nobody may ask
  mutable std::mutex mutex_;
  CommandLink link_;
  std::optional<double> stamp_origin_s_;
  std::deque<WireTime> times_;
};

/// Commands that rest on a frame have its capture; zeros that rest on none have not.
std::vector<WireTime> times_of(const std::vector<SentSetpoint>& sent) {
  std::vector<WireTime> times;
  for (const SentSetpoint& s : sent) {
    const bool rests = s.state == StreamState::Fresh || s.state == StreamState::Decay;
    times.push_back({s.sent_s, rests ? std::optional(s.capture_s) : std::nullopt});
  }
  return times;
}

constexpr const char* kAutopilot = "autopilot:";
constexpr const char* kUdp = "udp://";

/// What follows the start of a text, if it starts so.
std::optional<std::string> after(const std::string& text, const std::string& start) {
  if (text.rfind(start, 0) != 0) return std::nullopt;
  return text.substr(start.size());
}

void add_autopilot(Summary& summary, AutopilotLink& link) {
  link.stop();
  const AdapterStatus s = link.status();
  summary.begin_section("autopilot");
  summary.add("autopilot", s.autopilot ? name(*s.autopilot) : "none");
  summary.add("control", name(s.control));
  summary.add("why", s.words);
  summary.add("setpoints sent", std::int64_t(s.counts.setpoints));
  summary.add("of these zeros", std::int64_t(s.counts.zeros));
  summary.add("stale decisions", std::int64_t(s.decided.stale));
  summary.add("decisions not finite", std::int64_t(s.decided.not_finite));
  summary.add("attitudes received", std::int64_t(s.telemetry.attitudes));
  if (s.clock) summary.add("clock known within", s.clock->error_s * 1e3, "ms");
}

void add_vehicle(std::vector<Fact>& facts, const AdapterStatus& s) {
  if (!s.vehicle) return;
  const mavlink::Heartbeat& beat = s.vehicle->heartbeat;
  constexpr std::uint8_t kArmed = 128;  // MAV_MODE_FLAG_SAFETY_ARMED
  if (s.autopilot) facts.push_back({"Mode", mode_name(*s.autopilot, beat.custom_mode)});
  facts.push_back({"Armed", (beat.base_mode & kArmed) != 0 ? "yes" : "no"});
  facts.push_back({"Landed", name(s.vehicle->landed)});
  const Battery battery = s.vehicle->battery.value_or(Battery{});
  const bool low = is_low(battery);
  facts.push_back({"Battery", words(battery) + (low ? ": LOW" : ""),
                   low ? Fact::Tone::Warning : Fact::Tone::Plain});
}

/// What the autopilot tells of itself, and how the line to it is.
std::vector<Fact> facts_of(const AutopilotLink& link) {
  const AdapterStatus s = link.status();
  std::vector<Fact> facts{{"Autopilot", s.autopilot ? name(*s.autopilot) : "not heard"},
                          {"Control", std::string(name(s.control)) + ": " + s.words}};
  add_vehicle(facts, s);
  if (const auto motion = link.motion_at(link_clock_s())) {
    const Eigen::Vector3d& v = motion->velocity_ned_m_s;
    facts.push_back(
        {"Flies at", fmt::format("{:.2f} m/s, {:+.2f} m/s up", v.head<2>().norm(), -v.z())});
    facts.push_back(
        {"Height", fmt::format("{:.2f} m over its origin", -motion->position_ned_m.z())});
  }
  facts.push_back({"Setpoints", fmt::format("{}, {} of them zero; now {}", s.counts.setpoints,
                                            s.counts.zeros, name(s.stream))});
  facts.push_back(
      {"Heard", fmt::format("{} frames, {} damaged", s.counts.received, s.counts.malformed)});
  if (s.clock)
    facts.push_back({"Clock", fmt::format("known within {:.1f} ms", s.clock->error_s * 1e3)});
  return facts;
}

Sink autopilot_sink(const std::string& address, const AutopilotOptions& options,
                    std::optional<double> stamp_origin_s) {
  auto link = std::make_unique<AutopilotLink>(parse_address(address), options, stamp_origin_s);
  AutopilotLink& it = *link;
  Sink sink;
  sink.commands = std::move(link);
  sink.attitude = [&it](double stamp_s) { return it.attitude_at(stamp_s); };
  sink.report = [&it](Summary& summary) { add_autopilot(summary, it); };
  sink.take_times = [&it] { return times_of(it.take_sent()); };
  sink.facts = [&it] { return facts_of(it); };
  sink.lives_by_the_clock = true;
  return sink;
}

[[noreturn]] void refuse(const std::string& text) {
  throw std::invalid_argument("sink '" + text +
                              "': known are autopilot:udp://HOST:PORT, udp://HOST:PORT and none");
}

}  // namespace

Sink open_sink(const std::string& text, const AutopilotOptions& options,
               std::optional<double> stamp_origin_s) {
  if (text.empty() || text == "none")
    return {std::make_unique<NoSink>(), nullptr, nullptr, nullptr};
  if (after(text, kUdp)) {
    auto link = std::make_unique<TimedLink>(parse_address(text), stamp_origin_s);
    TimedLink& it = *link;
    return {std::move(link), nullptr, nullptr, [&it] { return it.take_times(); }};
  }
  if (const auto address = after(text, kAutopilot)) {
    return autopilot_sink(*address, options, stamp_origin_s);
  }
  refuse(text);
}

void check_sink(const std::string& text) {
  if (text.empty() || text == "none") return;
  const Address address = parse_address(after(text, kAutopilot).value_or(text));
  if (address.port == 0 || address.is_any()) refuse(text);
}

}  // namespace kestrel::app
