#include "kestrel/link/switch_report.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace kestrel {
namespace {

using Json = nlohmann::json;

SwitchReport sample() {
  SwitchReport report;
  report.core.now_s = 100;
  report.core.control = ControlState::Owned;
  report.core.owner = SourceId{7, 1, 191};
  report.core.sent.forward_m_s = 0.25;
  PeerStatus peer;
  peer.peer = 7;
  peer.link = 1;
  peer.from = {"::1", 14560};
  peer.connected_s = 90;
  peer.last_heard_s = 99.5;
  peer.counters.frames = 12;
  peer.counters.refused[std::size_t(Refused::BadCrc)] = 3;
  report.core.peers = {peer, {}};
  report.links.resize(2);
  report.links[1] = {"eyes", LinkRole::Vision, {LinkKind::UdpServer, {"::", 14560}}, {1, 2, 3, 4}};
  report.traffic = {{5, 6}, {}};
  return report;
}

TEST(SwitchReport, TellsEverythingInOneLine) {
  const std::string text = status_json(sample());
  EXPECT_EQ(text.find('\n'), std::string::npos);
  const Json json = Json::parse(text);
  EXPECT_EQ(json["control"], "owned");
  EXPECT_EQ(json["owner"]["component_id"], 191);
  EXPECT_EQ(json["sent"]["forward_m_s"], 0.25);
  const Json& link = json["links"][1];
  EXPECT_EQ(link["name"], "eyes");
  EXPECT_EQ(link["role"], "vision");
  EXPECT_EQ(link["url"], "udp-listen://[::]:14560");
  EXPECT_EQ(link["strangers"], 1);
  EXPECT_EQ(link["turned_away"], 2);
  EXPECT_EQ(link["attempts"], 3);
  EXPECT_EQ(link["dropped"], 4);
  const Json& peer = json["peers"][0];
  EXPECT_EQ(peer["link"], "eyes");
  EXPECT_EQ(peer["from"], "udp://[::1]:14560");
  EXPECT_EQ(peer["connected_s"], 10);
  EXPECT_EQ(peer["silent_s"], 0.5);
  EXPECT_EQ(peer["frames"], 12);
  EXPECT_EQ(peer["queued"], 5);
  EXPECT_EQ(peer["dropped"], 6);
  EXPECT_EQ(peer["refused"], Json({{"bad crc", 3}}));  // and nothing that did not occur
  EXPECT_TRUE(json["peers"][1]["silent_s"].is_null());
}

TEST(SwitchReport, AnEmptyOneIsJsonToo) {
  const Json json = Json::parse(status_json({}));
  EXPECT_TRUE(json["owner"].is_null());
  EXPECT_EQ(json["peers"], Json::array());
}

TEST(SwitchReport, AnEventIsALineWhateverItsWords) {
  const SwitchEvent event{12.5, 7, SwitchEventKind::Connected, "a\n\"b\"\xff"};
  const std::string text = event_json(event, 1e9);
  EXPECT_EQ(text.find('\n'), std::string::npos);
  const Json json = Json::parse(text);
  EXPECT_EQ(json["unix_s"], 1e9);
  EXPECT_EQ(json["stamp_s"], 12.5);
  EXPECT_EQ(json["peer"], 7);
  EXPECT_EQ(json["event"], "connected");
  EXPECT_EQ(json["words"], "a\n\"b\"\xEF\xBF\xBD");
}

}  // namespace
}  // namespace kestrel
