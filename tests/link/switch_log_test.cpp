#include "kestrel/link/switch_log.hpp"

#include <gtest/gtest.h>

namespace kestrel {
namespace {

TEST(SwitchLog, KeepsTheOrderAndGivesEachEventOnce) {
  SwitchLog log;
  log.add(1, 7, SwitchEventKind::Connected, "from here");
  log.add(2, 8, SwitchEventKind::Locked, "");
  const auto events = log.take();
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].stamp_s, 1);
  EXPECT_EQ(events[0].peer, 7u);
  EXPECT_EQ(events[0].words, "from here");
  EXPECT_EQ(events[1].kind, SwitchEventKind::Locked);
  EXPECT_TRUE(log.take().empty());
}

TEST(SwitchLog, IsBounded) {
  SwitchLog log;
  for (int i = 0; i < 3000; ++i) log.add(i, 1, SwitchEventKind::Connected, "");
  EXPECT_EQ(log.dropped(), 3000 - SwitchLog::kMost);
  const auto events = log.take();
  ASSERT_EQ(events.size(), SwitchLog::kMost);
  EXPECT_EQ(events.front().stamp_s, 0);
  log.add(1, 1, SwitchEventKind::Connected, "");
  EXPECT_EQ(log.take().size(), 1u);
}

TEST(SwitchLog, TellsRefusalsByPowersOfTen) {
  SwitchLog log;
  for (std::uint64_t i = 1; i <= 12345; ++i) log.refused(1, 2, Refused::Stale, i);
  const auto events = log.take();
  ASSERT_EQ(events.size(), 5u);  // 1, 10, 100, 1000, 10000
  EXPECT_EQ(events[3].words, "stale (1000)");
}

}  // namespace
}  // namespace kestrel
