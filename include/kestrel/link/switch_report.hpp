#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kestrel/link/link_place.hpp"
#include "kestrel/link/port_event.hpp"
#include "kestrel/link/switch_status.hpp"

namespace kestrel {

/// What a link has done, beside what the core knows of its peers.
struct LinkReport {
  std::string name;
  LinkRole role = LinkRole::Telemetry;
  LinkPlace place;  // with the real port
  PortCounts counts;
};

/// All that can be told of a running switch.
struct SwitchReport {
  SwitchStatus core;
  std::vector<LinkReport> links;
  std::vector<PeerTraffic> traffic;  // of core.peers, in their order
  std::uint64_t turns = 0;
  double longest_turn_s = 0;  // from the end of the waiting to the start of the next
};

/// The report as one line of JSON. Of the refusals of a peer those that occurred are named.
std::string status_json(const SwitchReport& report);

/// An event as one line of JSON: the wall's time, the monotonic one, who, what, in words.
std::string event_json(const SwitchEvent& event, double unix_s);

}  // namespace kestrel
