#include "kestrel/link/switch_options.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace kestrel {
namespace {

void require(bool right, const std::string& what) {
  if (!right) throw std::invalid_argument(what);
}

bool is_positive(double value) { return std::isfinite(value) && value > 0; }

bool is_somebody(const Recipient& who) { return who.system_id != 0 && who.component_id != 0; }

void check_link(const SwitchLink& link) {
  const std::string where = "links: " + link.name + ": ";
  require(is_positive(link.flow.frames_per_s), where + "frames_per_s: must be positive");
  require(std::isfinite(link.flow.burst) && link.flow.burst >= 1,
          where + "burst: must be at least 1 frame");
  require(link.priority >= 0, where + "priority: must not be negative");
  require(link.priority == 0 || default_priority(link.role) > 0,
          where + "priority: a " + name(link.role) + " link sends no setpoints");
  const bool companion = link.role == LinkRole::Vision || link.role == LinkRole::Script;
  require(!link.may.arm || companion, where + "arm: for vision and script links only");
  require(!link.may.manual_control || link.role == LinkRole::Ground,
          where + "manual_control: for ground links only");
  require(!link.may.aid_estimator || link.role == LinkRole::Vision,
          where + "aid_estimator: for vision links only");
}

void check_links(const std::vector<SwitchLink>& links) {
  std::set<std::string> names;
  for (const SwitchLink& link : links) {
    require(!link.name.empty(), "links: a link has no name");
    require(names.insert(link.name).second, "links: two are named " + link.name);
    check_link(link);
  }
  const auto flights = std::count_if(links.begin(), links.end(), [](const SwitchLink& link) {
    return link.role == LinkRole::Flight;
  });
  require(flights == 1, "links: one of them must have the role flight, and only one");
}

}  // namespace

const char* name(LinkRole role) {
  constexpr const char* kNames[kLinkRoles] = {"flight", "vision", "ground", "script", "telemetry"};
  return kNames[std::size_t(role)];
}

int default_priority(LinkRole role) {
  switch (role) {
    case LinkRole::Ground:
      return 100;
    case LinkRole::Vision:
      return 50;
    case LinkRole::Script:
      return 10;
    case LinkRole::Flight:
    case LinkRole::Telemetry:
      return 0;
  }
  return 0;
}

void SwitchOptions::check() const {
  check_links(links);
  require(is_somebody(vehicle), "vehicle: system and component must be 1 to 255");
  require(is_somebody(self), "self: system and component must be 1 to 255");
  require(vehicle.system_id != self.system_id || vehicle.component_id != self.component_id,
          "self: the ids are the vehicle's");
  envelope.check();
  require(is_positive(rate_hz) && rate_hz >= 2 && rate_hz <= 1000,
          "rate_hz: must be from 2 to 1000, or an autopilot gives up");
  require(is_positive(deadman_s) && deadman_s >= 1 / rate_hz,
          "deadman_s: must be at least one period of rate_hz");
  require(is_positive(time_to_live_s), "time_to_live_s: must be positive");
  require(is_positive(heartbeat_period_s), "heartbeat_period_s: must be positive");
  require(missed_heartbeats >= 1, "missed_heartbeats: must be at least 1");
  require(max_peers >= 1, "max_peers: must be at least 1");
}

}  // namespace kestrel
