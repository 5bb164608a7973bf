#include "kestrel/link/switch_loop.hpp"

#include <atomic>
#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

#include "kestrel/link/frame.hpp"

#include "loopback.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

const mavlink::EncodedFrame kBeat = mavlink::encode(mavlink::Heartbeat{}, {1, 191, 0});

SwitchTime clock_now() {
  const auto since = std::chrono::steady_clock::now().time_since_epoch();
  return {std::chrono::duration<double>(since).count(), 1.8e9};
}

/// A switch over loopback: a flight link first, then what else is asked for.
SwitchLoopOptions options_of(const std::vector<std::pair<LinkRole, LinkPlace>>& links) {
  SwitchLoopOptions options;
  for (const auto& [role, place] : links) {
    SwitchLink link;
    link.name = "link" + std::to_string(options.core.links.size());
    link.role = role;
    options.core.links.push_back(link);
    options.places.push_back({place, {}});
  }
  return options;
}

/// Turns until a condition holds, at most for kPatience_s.
template <class Condition>
bool turns_until(SwitchLoop& loop, const Condition& condition) {
  const double end_s = clock_now().now_s + test::kPatience_s;
  while (!condition()) {
    if (clock_now().now_s > end_s) return false;
    loop.turn();
  }
  return true;
}

TEST(SwitchLoop, PeersOfEveryKindComeAndGo) {
  UdpSocket autopilot = UdpSocket::bound_to({"127.0.0.1", 0});
  SwitchLoop loop(options_of({{LinkRole::Ground, {LinkKind::TcpServer, {"127.0.0.1", 0}}},
                              {LinkRole::Vision, {LinkKind::UdpServer, {"127.0.0.1", 0}}},
                              {LinkRole::Flight, {LinkKind::UdpClient, autopilot.local()}}}),
                  clock_now);
  const auto peers = [&] { return loop.report().core.peers; };
  ASSERT_TRUE(turns_until(loop, [&] { return peers().size() == 1; }));
  EXPECT_EQ(peers()[0].link, 2u);  // served first, told by its own place
  UdpSocket eyes = UdpSocket::connected_to(loop.address(1));
  eyes.send(kBeat.bytes());
  ASSERT_TRUE(turns_until(loop, [&] { return peers().size() == 2; }));
  {
    const StreamSocket ground = StreamSocket::connecting_to(loop.address(0));
    ASSERT_TRUE(turns_until(loop, [&] { return peers().size() == 3; }));
    EXPECT_EQ(loop.report().traffic.size(), 3u);
  }
  EXPECT_TRUE(turns_until(loop, [&] { return peers().size() == 2; }));
}

// However much waits at one socket: the others have their turn after a batch of it.
TEST(SwitchLoop, TakesABatchOfEachSocketInATurn) {
  SwitchLoop loop(options_of({{LinkRole::Script, {LinkKind::UdpServer, {"127.0.0.1", 0}}},
                              {LinkRole::Vision, {LinkKind::UdpServer, {"127.0.0.1", 0}}},
                              {LinkRole::Flight, {LinkKind::UdpServer, {"127.0.0.1", 0}}}}),
                  clock_now);
  UdpSocket noise = UdpSocket::connected_to(loop.address(0));
  UdpSocket eyes = UdpSocket::connected_to(loop.address(1));
  for (int i = 0; i < 40; ++i) noise.send(kBeat.bytes());
  eyes.send(mavlink::encode(mavlink::Heartbeat{}, {1, 192, 0}).bytes());
  loop.turn();
  const auto peers = loop.report().core.peers;
  ASSERT_EQ(peers.size(), 2u);
  EXPECT_EQ(peers[0].counters.chunks, SwitchLoopOptions{}.batch);
  EXPECT_EQ(peers[1].counters.chunks, 1u);
}

TEST(SwitchLoop, TellsItsStatusToWhoAsks) {
  const test::TempFolder folder;
  SwitchLoopOptions options = options_of({{LinkRole::Flight, {LinkKind::UdpServer, {"::1", 0}}}});
  options.places[0].place.address = {"127.0.0.1", 0};
  options.status = folder / "status";
  SwitchLoop loop(options, clock_now);
  std::string answer;
  std::atomic<bool> answered{false};
  std::thread asker([&] {
    answer = ask_status(options.status, test::kPatience_s);
    answered = true;
  });
  EXPECT_TRUE(turns_until(loop, [&] { return answered.load(); }));
  asker.join();
  EXPECT_NE(answer.find("\"control\":\"idle\""), std::string::npos) << answer;
  EXPECT_NE(answer.find("udp-listen://127.0.0.1:"), std::string::npos) << answer;
}

TEST(SwitchLoop, SleepsWhenNothingHappens) {
  SwitchLoop loop(options_of({{LinkRole::Flight, {LinkKind::UdpServer, {"127.0.0.1", 0}}}}),
                  clock_now);
  const double start_s = clock_now().now_s;
  while (clock_now().now_s < start_s + 0.1) loop.turn();
  EXPECT_LE(loop.report().turns, 25u);  // one each 5 ms
}

TEST(SwitchLoop, RefusesWhatCannotBe) {
  const auto flight = options_of({{LinkRole::Flight, {LinkKind::UdpServer, {"127.0.0.1", 0}}}});
  SwitchLoopOptions missing = flight;
  missing.places.clear();
  EXPECT_THROW(SwitchLoop(missing, clock_now), std::invalid_argument);
  SwitchLoopOptions never = flight;
  never.batch = 0;
  EXPECT_THROW(SwitchLoop(never, clock_now), std::invalid_argument);
  SwitchLoopOptions port = flight;
  port.places[0].port.max_peers = 0;
  EXPECT_THROW(SwitchLoop(port, clock_now), std::invalid_argument);
  const UdpSocket holder = UdpSocket::bound_to({"127.0.0.1", 0});
  SwitchLoopOptions taken = flight;
  taken.places[0].place.address = holder.local();
  EXPECT_THROW(SwitchLoop(taken, clock_now), std::runtime_error);
}

}  // namespace
}  // namespace kestrel
