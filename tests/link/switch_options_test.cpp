#include "kestrel/link/switch_options.hpp"

#include <functional>
#include <limits>
#include <stdexcept>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace kestrel {
namespace {

SwitchLink link(const char* named, LinkRole role) {
  SwitchLink made;
  made.name = named;
  made.role = role;
  return made;
}

SwitchOptions usual() {
  SwitchOptions options;
  options.links = {link("fc", LinkRole::Flight), link("eye", LinkRole::Vision),
                   link("gcs", LinkRole::Ground), link("log", LinkRole::Telemetry)};
  return options;
}

TEST(SwitchOptions, AreRightAsTheyCome) { EXPECT_NO_THROW(usual().check()); }

TEST(SwitchOptions, RankTheOperatorFirstAndListenersNever) {
  EXPECT_GT(default_priority(LinkRole::Ground), default_priority(LinkRole::Vision));
  EXPECT_GT(default_priority(LinkRole::Vision), default_priority(LinkRole::Script));
  EXPECT_GT(default_priority(LinkRole::Script), 0);
  EXPECT_EQ(default_priority(LinkRole::Telemetry), 0);
  EXPECT_EQ(default_priority(LinkRole::Flight), 0);
}

TEST(SwitchOptions, NameWhatIsWrong) {
  using Break = std::function<void(SwitchOptions&)>;
  const std::vector<std::pair<const char*, Break>> wrong = {
      {"links", [](auto& o) { o.links.clear(); }},
      {"flight", [](auto& o) { o.links[1].role = LinkRole::Flight; }},
      {"no name", [](auto& o) { o.links[1].name = ""; }},
      {"two are named fc", [](auto& o) { o.links[1].name = "fc"; }},
      {"eye: frames_per_s", [](auto& o) { o.links[1].flow.frames_per_s = 0; }},
      {"eye: burst", [](auto& o) { o.links[1].flow.burst = 0.5; }},
      {"eye: priority", [](auto& o) { o.links[1].priority = -1; }},
      {"log: priority", [](auto& o) { o.links[3].priority = 5; }},
      {"gcs: arm", [](auto& o) { o.links[2].may.arm = true; }},
      {"eye: manual_control", [](auto& o) { o.links[1].may.manual_control = true; }},
      {"gcs: aid_estimator", [](auto& o) { o.links[2].may.aid_estimator = true; }},
      {"vehicle", [](auto& o) { o.vehicle.system_id = 0; }},
      {"self", [](auto& o) { o.self.component_id = 0; }},
      {"self", [](auto& o) { o.self = o.vehicle; }},
      {"speed", [](auto& o) { o.envelope.speed.forward_m_s = -1; }},
      {"rate_hz", [](auto& o) { o.rate_hz = std::numeric_limits<double>::quiet_NaN(); }},
      {"rate_hz", [](auto& o) { o.rate_hz = 1; }},
      {"deadman_s", [](auto& o) { o.deadman_s = 0.01; }},
      {"time_to_live_s", [](auto& o) { o.time_to_live_s = 0; }},
      {"heartbeat_period_s", [](auto& o) { o.heartbeat_period_s = -1; }},
      {"missed_heartbeats", [](auto& o) { o.missed_heartbeats = 0; }},
      {"max_peers", [](auto& o) { o.max_peers = 0; }},
  };
  for (const auto& [word, spoil] : wrong) {
    SwitchOptions options = usual();
    spoil(options);
    try {
      options.check();
      ADD_FAILURE() << word;
    } catch (const std::invalid_argument& mistake) {
      EXPECT_THAT(mistake.what(), testing::HasSubstr(word));
    }
  }
}

}  // namespace
}  // namespace kestrel
