// The fault table of the link, the row of connections: restart, reconnect, half-open TCP and slow
// readers, over the switch with its sockets. Nobody else is stalled.
#include <algorithm>
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "link/running_switch.hpp"
#include "link/soak_peers.hpp"
#include "link/tcp_relay.hpp"

namespace kestrel::test {
namespace {

/// One setpoint in the deadman time keeps the vehicle moving; ten periods of silence are a fault
/// that no scheduler of a loaded machine explains (see last_command_test).
constexpr double kLongestGap_s = 0.5;

class Connections : public testing::Test {
 protected:
  /// Everybody's turn for a time.
  template <class Others>
  void pass(double duration_s, const Others& others) {
    const double end_s = monotonic_s() + duration_s;
    while (monotonic_s() < end_s) {
      flight_.turn(monotonic_s());
      companion_.turn(monotonic_s());
      others(monotonic_s());
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  RelayOptions to_ground() const {
    RelayOptions options;
    options.to = running_.address(2);
    return options;
  }

  void expect_undisturbed(double duration_s) const {
    EXPECT_EQ(flight_.wrong(), 0);
    EXPECT_GT(flight_.moves(), long(duration_s * 15));
    EXPECT_LT(flight_.longest_gap_s(), kLongestGap_s);
  }

  SoakFlight flight_{CommandLimits{}};
  RunningSwitch running_{loopback_switch(flight_.local())};
  SoakSource companion_{running_.address(1), 191, {0.5, 0.25, 0, 0.1}, 30};
};

TEST_F(Connections, AHalfOpenOneStallsNobodyElse) {
  TcpRelay wire(to_ground());
  SoakGround ground(wire.local(), 255, SoakGround::Reads::All);
  SoakGround other(running_.address(2), 254, SoakGround::Reads::All);
  const auto both = [&](double now_s) {
    ground.turn(now_s);
    other.turn(now_s);
  };
  pass(0.5, both);
  wire.block();
  const long read_before = other.read_bytes();
  pass(2, both);
  expect_undisturbed(2.5);
  EXPECT_GT(other.read_bytes(), read_before + 500 * 20);  // 500 reports a second go on
}

TEST_F(Connections, ASlowReaderLosesTheOldestAndDelaysNobody) {
  SoakGround deaf(running_.address(2), 255, SoakGround::Reads::Nothing);
  SoakGround other(running_.address(2), 254, SoakGround::Reads::All);
  pass(2.5, [&](double now_s) {
    deaf.turn(now_s);
    other.turn(now_s);
  });
  expect_undisturbed(2.5);
  EXPECT_GT(other.read_bytes(), 500 * 20);
  running_.end();
  const SwitchReport report = running_.report();
  for (const PeerTraffic& traffic : report.traffic) EXPECT_LE(traffic.queued, 4096u);
}

TEST_F(Connections, OneThatIsResetComesBackAndIsHeardAgain) {
  TcpRelay wire(to_ground());
  SoakGround ground(wire.local(), 255, SoakGround::Reads::All);
  const auto turn = [&](double now_s) { ground.turn(now_s); };
  pass(0.5, turn);
  for (long times = 2; times <= 4; ++times) {
    wire.cut();
    pass(0.5, turn);
    EXPECT_EQ(ground.connections(), times);
  }
  const long before = ground.read_bytes();
  pass(0.5, turn);
  EXPECT_GT(ground.read_bytes(), before);
  expect_undisturbed(2.5);
}

TEST_F(Connections, ACompanionThatRestartsIsObeyedAgain) {
  const auto nobody = [](double) {};
  pass(1, nobody);
  const long before = flight_.moves();
  SoakSource again(running_.address(1), 191, {0.5, 0.25, 0, 0.1}, 30);  // from another port
  const double end_s = monotonic_s() + 3;
  while (monotonic_s() < end_s) {
    flight_.turn(monotonic_s());
    again.turn(monotonic_s());
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_GT(flight_.moves(), before + 15);
  EXPECT_EQ(flight_.wrong(), 0);
}

}  // namespace
}  // namespace kestrel::test
