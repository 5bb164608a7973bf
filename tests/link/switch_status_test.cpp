#include "kestrel/link/switch_status.hpp"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

TEST(SwitchStatus, NamesEachEventAndStateApart) {
  std::set<std::string> events;
  for (int i = 0; i <= int(SwitchEventKind::Shutdown); ++i) events.insert(name(SwitchEventKind(i)));
  EXPECT_EQ(events.size(), std::size_t(SwitchEventKind::Shutdown) + 1);
  EXPECT_EQ(name(SwitchEventKind::Shutdown), std::string("shutdown"));
  std::set<std::string> states;
  for (int i = 0; i <= int(ControlState::Stopped); ++i) states.insert(name(ControlState(i)));
  EXPECT_EQ(states.size(), std::size_t(ControlState::Stopped) + 1);
  EXPECT_EQ(name(ControlState::Stopped), std::string("stopped"));
}

TEST(SourceId, TellsPeersSystemsAndComponentsApart) {
  const SourceId one{1, 2, 3};
  EXPECT_EQ(one, (SourceId{1, 2, 3}));
  EXPECT_NE(one, (SourceId{9, 2, 3}));
  EXPECT_NE(one, (SourceId{1, 9, 3}));
  EXPECT_NE(one, (SourceId{1, 2, 9}));
}

}  // namespace
}  // namespace kestrel
