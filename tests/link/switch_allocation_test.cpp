// Nothing is allocated while the switch does what it always does.
#include <gtest/gtest.h>

#include "kestrel/link/setpoint.hpp"
#include "kestrel/link/switch_core.hpp"

#include "support/allocations.hpp"

namespace kestrel {
namespace {

using test::allocations;

SwitchOptions with_roles() {
  SwitchOptions options;
  options.links.resize(4);
  const LinkRole roles[] = {LinkRole::Flight, LinkRole::Vision, LinkRole::Ground, LinkRole::Script};
  for (std::size_t i = 0; i < 4; ++i) {
    options.links[i].name = name(roles[i]);
    options.links[i].role = roles[i];
  }
  options.links[0].key = mavlink::SigningKey({1, 2, 3});
  return options;
}

/// What a second of flight brings: setpoints of an owner and of one who is not, telemetry,
/// heartbeats, damage, ticks. Returns the frames that left.
long fly_a_second(SwitchCore& core, double start_s, std::uint8_t& sequence) {
  long left = 0;
  for (int i = 0; i < 50; ++i) {
    const SwitchTime time{start_s + 0.02 * i, 1.7e9 + start_s + 0.02 * i};
    const std::uint32_t ms = time_boot_ms(time.now_s);
    const auto say = [&](PeerId peer, const mavlink::Message& message, std::uint8_t component) {
      const auto frame = mavlink::encode(message, {10, component, sequence});
      left += long(core.receive(peer, frame.bytes(), time).size());
    };
    ++sequence;
    say(2, velocity_setpoint({0.5, 0, 0, 0}, ms, {}), 191);
    say(4, velocity_setpoint({0.5, 0, 0, 0}, ms, {}), 193);
    say(2, mavlink::TimeSync{}, 195);
    say(3, mavlink::Heartbeat{}, 190);
    const auto attitude = mavlink::signed_frame(mavlink::AttitudeReport{}, {1, 1, sequence},
                                                {0, mavlink::signing_time(time.unix_s)},
                                                mavlink::SigningKey({1, 2, 3}));
    left += long(core.receive(1, attitude.bytes(), time).size());
    if (i == 0) {
      say(2, mavlink::Heartbeat{}, 191);
      say(4, mavlink::Heartbeat{}, 193);
      ++sequence;
    }
    left += long(core.tick(time).size());
  }
  return left;
}

TEST(SwitchAllocation, ThereIsNoneInSteadyState) {
  SwitchCore core(with_roles());
  std::uint8_t sequence = 0;
  for (PeerId peer = 1; peer <= 4; ++peer) core.connect(peer, peer - 1, {"::1", 5}, {0, 1.7e9});
  // The first seconds make room, and tell the first, tenth and hundredth refusal to the log.
  for (int second = 1; second <= 3; ++second) fly_a_second(core, second, sequence);
  core.take_events();
  const int before = allocations;
  const long left = fly_a_second(core, 4, sequence);
  EXPECT_EQ(allocations, before);
  EXPECT_GT(left, 200);
}

}  // namespace
}  // namespace kestrel
