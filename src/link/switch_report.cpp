#include "kestrel/link/switch_report.hpp"

#include <nlohmann/json.hpp>

namespace kestrel {
namespace {

using Json = nlohmann::ordered_json;

/// Bytes that are no UTF-8, should any get into a name, are replaced and do not throw.
std::string line_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json refusals_of(const PeerCounters& counters) {
  Json refusals = Json::object();
  for (std::size_t i = 0; i < kRefusedReasons; ++i) {
    if (counters.refused[i] > 0) refusals[name(Refused(i))] = counters.refused[i];
  }
  return refusals;
}

Json json_of(const PeerStatus& peer, const PeerTraffic& traffic, const SwitchReport& report) {
  const PeerCounters& c = peer.counters;
  Json json = {{"peer", peer.peer},
               {"link", peer.link < report.links.size() ? report.links[peer.link].name : ""},
               {"from", to_string(peer.from)},
               {"connected_s", report.core.now_s - peer.connected_s}};
  json["silent_s"] = peer.last_heard_s ? Json(report.core.now_s - *peer.last_heard_s) : Json();
  json.update({{"chunks", c.chunks},
               {"bytes", c.bytes},
               {"frames", c.frames},
               {"setpoints", c.setpoints},
               {"forwarded", c.forwarded},
               {"kept", c.kept},
               {"delivered", c.delivered},
               {"queued", traffic.queued},
               {"dropped", traffic.dropped},
               {"refused", refusals_of(c)}});
  return json;
}

Json json_of(const LinkReport& link) {
  return {{"name", link.name},
          {"role", name(link.role)},
          {"url", to_string(link.place)},
          {"strangers", link.counts.strangers},
          {"turned_away", link.counts.turned_away},
          {"attempts", link.counts.attempts},
          {"dropped", link.counts.dropped}};
}

Json json_of(const VelocityCommand& command) {
  return {{"forward_m_s", command.forward_m_s},
          {"right_m_s", command.right_m_s},
          {"down_m_s", command.down_m_s},
          {"yaw_rate_rad_s", command.yaw_rate_rad_s}};
}

Json json_of(const std::optional<SourceId>& owner) {
  if (!owner) return {};
  return {{"peer", owner->peer},
          {"system_id", owner->system_id},
          {"component_id", owner->component_id}};
}

}  // namespace

std::string status_json(const SwitchReport& report) {
  Json json = {{"now_s", report.core.now_s}, {"control", name(report.core.control)}};
  json["owner"] = json_of(report.core.owner);
  json["sent"] = json_of(report.core.sent);
  json.update({{"setpoints_sent", report.core.setpoints_sent},
               {"zeros_sent", report.core.zeros_sent},
               {"events_dropped", report.core.events_dropped},
               {"turns", report.turns},
               {"longest_turn_s", report.longest_turn_s}});
  json["links"] = Json::array();
  for (const LinkReport& link : report.links) json["links"].push_back(json_of(link));
  json["peers"] = Json::array();
  for (std::size_t i = 0; i < report.core.peers.size(); ++i) {
    const PeerTraffic traffic = i < report.traffic.size() ? report.traffic[i] : PeerTraffic{};
    json["peers"].push_back(json_of(report.core.peers[i], traffic, report));
  }
  return line_of(json);
}

std::string event_json(const SwitchEvent& event, double unix_s) {
  return line_of(Json{{"unix_s", unix_s},
                      {"stamp_s", event.stamp_s},
                      {"peer", event.peer},
                      {"event", name(event.kind)},
                      {"words", event.words}});
}

}  // namespace kestrel
