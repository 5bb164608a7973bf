#include "switch_table.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace kestrel::app {
namespace {

using Json = nlohmann::ordered_json;

/// A number that a JSON without digits after the point may hold as an integer.
double number(const Json& json, const char* key) { return json.at(key).get<double>(); }
long count(const Json& json, const char* key) { return json.at(key).get<long>(); }
std::string text(const Json& json, const char* key) { return json.at(key).get<std::string>(); }

std::string control_lines(const Json& status) {
  const Json& owner = status.at("owner");
  const std::string who =
      owner.is_null() ? "nobody"
                      : fmt::format("system {}, component {}, peer {}", count(owner, "system_id"),
                                    count(owner, "component_id"), count(owner, "peer"));
  const Json& sent = status.at("sent");
  return fmt::format(
      "control: {}; owner: {}\nsent last: forward {:+.3f}  right {:+.3f}  down {:+.3f} m/s  yaw "
      "{:+.2f} deg/s\nsetpoints sent: {}, of these zeros: {}\n",
      text(status, "control"), who, number(sent, "forward_m_s"), number(sent, "right_m_s"),
      number(sent, "down_m_s"), number(sent, "yaw_rate_rad_s") * 180 / M_PI,
      count(status, "setpoints_sent"), count(status, "zeros_sent"));
}

std::string link_line(const Json& link) {
  return fmt::format("  {:12} {:9} {}; turned away {}, noise {}, not sent {}\n", text(link, "name"),
                     text(link, "role"), text(link, "url"), count(link, "turned_away"),
                     count(link, "strangers"), count(link, "dropped"));
}

std::string peer_line(const Json& peer) {
  const std::string silent = peer.at("silent_s").is_null()
                                 ? "never heard"
                                 : fmt::format("heard {:.1f} s ago", number(peer, "silent_s"));
  std::string refused;
  for (const auto& [reason, times] : peer.at("refused").items()) {
    refused +=
        fmt::format("{} {} {}", refused.empty() ? "; refused:" : ",", reason, times.get<long>());
  }
  return fmt::format(
      "  {:12} {}, {}: {} frames, {} setpoints, {} passed on, {} sent to it, {} dropped{}\n",
      text(peer, "link"), text(peer, "from"), silent, count(peer, "frames"),
      count(peer, "setpoints"), count(peer, "forwarded"), count(peer, "delivered"),
      count(peer, "dropped"), refused);
}

}  // namespace

std::string switch_table(const std::string& json) {
  try {
    const Json status = Json::parse(json);
    std::string table = control_lines(status) + "links\n";
    for (const Json& link : status.at("links")) table += link_line(link);
    table += "peers\n";
    for (const Json& peer : status.at("peers")) table += peer_line(peer);
    return table +
           fmt::format("longest turn: {:.2f} ms\n", 1000 * number(status, "longest_turn_s"));
  } catch (const Json::exception& error) {
    throw std::runtime_error(std::string("the answer is no switch's status: ") + error.what());
  }
}

}  // namespace kestrel::app
