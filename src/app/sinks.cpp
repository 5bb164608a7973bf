#include "sinks.hpp"

#include <stdexcept>

#include "kestrel/link/autopilot_link.hpp"
#include "kestrel/link/command_link.hpp"

namespace kestrel::app {
namespace {

class NoSink final : public CommandSink {
 public:
  void send(const VelocityCommand&, double) noexcept override {}
  long failures() const override { return 0; }
};

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

Sink autopilot_sink(const std::string& address, const AutopilotOptions& options,
                    std::optional<double> stamp_origin_s) {
  auto link = std::make_unique<AutopilotLink>(parse_address(address), options, stamp_origin_s);
  AutopilotLink& it = *link;
  return {std::move(link), [&it](double stamp_s) { return it.attitude_at(stamp_s); },
          [&it](Summary& summary) { add_autopilot(summary, it); }};
}

[[noreturn]] void refuse(const std::string& text) {
  throw std::invalid_argument("sink '" + text +
                              "': known are autopilot:udp://HOST:PORT, udp://HOST:PORT and none");
}

}  // namespace

Sink open_sink(const std::string& text, const AutopilotOptions& options,
               std::optional<double> stamp_origin_s) {
  if (text.empty() || text == "none") return {std::make_unique<NoSink>(), nullptr, nullptr};
  if (after(text, kUdp)) {
    return {std::make_unique<CommandLink>(parse_address(text)), nullptr, nullptr};
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
