#include "kestrel/link/switch_core.hpp"

#include <gtest/gtest.h>

namespace kestrel {
namespace {

SwitchOptions options() {
  SwitchOptions made;
  made.links.resize(2);
  made.links[0].name = "fc";
  made.links[0].role = LinkRole::Flight;
  made.links[1].name = "eye";
  made.links[1].role = LinkRole::Vision;
  made.max_peers = 2;
  return made;
}

TEST(SwitchCore, KnowsWhoIsConnected) {
  SwitchCore core(options());
  const Address from{"127.0.0.1", 5000};
  core.connect(7, 0, from, {1, 0});
  core.connect(8, 1, from, {2, 0});
  core.connect(9, 1, from, {3, 0});
  core.disconnect(7, {4, 0});
  const SwitchStatus status = core.status({5, 0});
  ASSERT_EQ(status.peers.size(), 1u);
  EXPECT_EQ(status.peers[0].peer, 8u);
  EXPECT_EQ(status.peers[0].link, 1u);
  EXPECT_EQ(status.peers[0].connected_s, 2);
  const auto events = core.take_events();
  ASSERT_EQ(events.size(), 4u);
  EXPECT_EQ(events[2].kind, SwitchEventKind::TooManyPeers);
  EXPECT_EQ(events[3].kind, SwitchEventKind::Disconnected);
  EXPECT_TRUE(core.take_events().empty());
}

}  // namespace
}  // namespace kestrel
