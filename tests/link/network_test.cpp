// The real programs on two computers with a cable and a firewall between them: network namespaces,
// veth and nftables. Where those are not permitted the whole program is skipped (exit 77).
#include <chrono>
#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <thread>

#include <gtest/gtest.h>

#include "kestrel/link/command_link.hpp"
#include "kestrel/link/command_receiver.hpp"

#include "cli/program.hpp"
#include "cli/rendered_sequence.hpp"
#include "link/flight_listener.hpp"
#include "link/two_networks.hpp"
#include "support/temp_folder.hpp"

namespace kestrel::test {
namespace {

namespace fs = std::filesystem;
using Side = TwoNetworks::Side;

constexpr std::uint16_t kPort = 5005;

/// A sender on the near side and a receiver on the far one.
struct Ends {
  Ends(const TwoNetworks& networks, const Address& at) {
    networks.stand(Side::Far, [&] { receiver.emplace(at); });
    networks.stand(Side::Near, [&] { sender.emplace(at); });
  }

  void send(int count) {
    for (int i = 0; i < count; ++i) sender->send({1, 0, 0, 0}, stamp_s += 0.05);
  }

  /// Commands that arrive while there are any.
  long received(double wait_s = 0.1) {
    long count = 0;
    for (auto got = receiver->poll(wait_s); !got.empty(); got = receiver->poll(wait_s)) {
      count += long(got.size());
    }
    return count;
  }

  std::optional<CommandReceiver> receiver;
  std::optional<CommandLink> sender;
  double stamp_s = 0;
};

/// One pair of networks for all tests: making one takes a second.
class Network : public testing::Test {
 protected:
  static void SetUpTestSuite() { networks_ = std::make_unique<TwoNetworks>(); }
  static void TearDownTestSuite() { networks_.reset(); }
  void TearDown() override { networks_->clear_rules(Side::Far); }

  static inline std::unique_ptr<TwoNetworks> networks_;
};

TEST_F(Network, CommandsCrossItOverBothProtocols) {
  const TwoNetworks& networks = *networks_;
  for (const Address& at :
       {TwoNetworks::ipv4(Side::Far, kPort), TwoNetworks::ipv6(Side::Far, kPort)}) {
    Ends ends(networks, at);
    ends.send(50);
    EXPECT_EQ(ends.received(), 50) << at.host;
    EXPECT_EQ(ends.sender->failures(), 0) << at.host;
    EXPECT_EQ(ends.receiver->counts().malformed(), 0);
  }
}

TEST_F(Network, WhatAFirewallDropsIsLostWithoutAWordAndCountedByTheReceiver) {
  const TwoNetworks& networks = *networks_;
  Ends ends(networks, TwoNetworks::ipv4(Side::Far, kPort));
  ends.send(10);
  EXPECT_EQ(ends.received(), 10);
  networks.rule(Side::Far, "udp dport 5005 drop");
  ends.send(40);
  EXPECT_EQ(ends.received(), 0);
  EXPECT_EQ(ends.sender->failures(), 0);  // UDP tells nobody
  networks.clear_rules(Side::Far);
  ends.send(10);
  EXPECT_EQ(ends.received(), 10);
  // With the heartbeats of two seconds among them.
  EXPECT_EQ(ends.receiver->counts().lost,
            40 + ends.sender->counts().heartbeats - ends.receiver->counts().heartbeats);
}

TEST_F(Network, WhatAFirewallRejectsIsCountedBySenderWhoGoesOn) {
  const TwoNetworks& networks = *networks_;
  Ends ends(networks, TwoNetworks::ipv4(Side::Far, kPort));
  networks.rule(Side::Far, "udp dport 5005 reject");  // ICMP: port unreachable
  for (int i = 0; i < 20; ++i) {
    ends.send(1);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));  // the answer's way back
  }
  EXPECT_EQ(ends.received(), 0);
  EXPECT_GE(ends.sender->failures(), 2);  // the kernel limits how many refusals it tells (RFC 1812)
  networks.clear_rules(Side::Far);
  ends.send(10);
  EXPECT_EQ(ends.received(), 10);
}

TEST_F(Network, ARateLimitCostsCommandsAndNothingElse) {
  const TwoNetworks& networks = *networks_;
  Ends ends(networks, TwoNetworks::ipv4(Side::Far, kPort));
  networks.rule(Side::Far, "udp dport 5005 limit rate over 10/second burst 5 packets drop");
  ends.send(200);  // at once
  const long got = ends.received();
  EXPECT_GE(got, 1);
  EXPECT_LT(got, 100);
  EXPECT_EQ(ends.receiver->counts().malformed(), 0);
  EXPECT_EQ(ends.receiver->counts().duplicates + ends.receiver->counts().late, 0);
}

// The kernel keeps what finds no neighbour, and sends it when there is one again: old commands in a
// burst. Whoever obeys commands must look at their age.
TEST_F(Network, ACablePulledIsSilenceAndWhatWasHeldBackComesInABurst) {
  for (const Address& at :
       {TwoNetworks::ipv4(Side::Far, kPort), TwoNetworks::ipv6(Side::Far, kPort)}) {
    Ends ends(*networks_, at);
    ends.send(5);
    EXPECT_EQ(ends.received(), 5);
    networks_->unplug();
    ends.send(20);
    EXPECT_EQ(ends.received(), 0);
    networks_->plug();
    const long held_back = ends.received();
    EXPECT_LE(held_back, 20);
    std::printf("%s: %ld of 20 commands came after the cable was back\n", at.host.c_str(),
                held_back);
    ends.send(5);
    EXPECT_EQ(ends.received(), 5) << at.host;
  }
}

/// A rendered sequence and a task that servoes on it.
class ServoNetwork : public Network {
 protected:
  void render(int frames) {
    const RenderedSequence sequence = rendered_sequence(folder_ / "frames", frames);
    folder_.write(
        "task.yaml",
        "source: images:frames/%04d.png\nrate_hz: 20\n"
        "camera: {intrinsics_px: [300, 300, 159.5, 119.5], size_px: [320, 240], "
        "body_from_camera: {translation_m: [0, 0, 0], rpy_deg: [90, 0, 90]}}\n"
        "target: {width_m: 1, height_m: 1, template_px: [" +
            sequence.roi +
            "]}\ngoal_camera_from_target: {translation_m: [0, 0, 2], rpy_deg: [0, 0, 0]}\n"
            "servo: {gain_per_s: 0.5}\n");
  }

  Program start(Side side, const std::vector<std::string>& arguments) {
    std::vector<std::string> words = {KESTREL_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return Program(Command{networks_->inside(side, words)}, folder_.path());
  }

  std::vector<std::string> servo(const Address& sink) const {
    return {"servo", "task.yaml", "--no-video", "--output", "out", "--sink", to_string(sink)};
  }

  /// Waits for a file, or for a test that fails.
  void wait_for(const std::string& file) const {
    for (int i = 0; i < 2000 && !fs::exists(folder_ / file); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }

  std::vector<std::string> lines(const std::string& file) const {
    std::ifstream in(folder_ / file);
    std::vector<std::string> all;
    for (std::string line; std::getline(in, line);) all.push_back(line);
    return all;
  }

  TempFolder folder_;
};

TEST_F(ServoNetwork, ServoesTheFlightControllerOnTheOtherComputer) {
  render(10);
  for (const Address& at :
       {TwoNetworks::ipv4(Side::Far, kPort), TwoNetworks::ipv6(Side::Far, kPort)}) {
    fs::remove(folder_ / "commands.csv");
    Program receiver = start(Side::Far, {"receive", to_string(at), "--count", "11", "--duration",
                                         "30", "--log", "commands.csv"});
    wait_for("commands.csv");
    const Outcome sent = start(Side::Near, servo(at)).wait();
    EXPECT_EQ(sent.exit_code, 0) << sent.err;
    const Outcome received = receiver.wait();
    EXPECT_EQ(received.exit_code, 0) << received.err;
    EXPECT_EQ(lines("commands.csv").size(), 12u);  // header, ten frames, the goodbye
  }
}

TEST_F(ServoNetwork, RunsToItsEndBehindAFirewallThatRejectsAndSaysSo) {
  render(10);
  networks_->rule(Side::Far, "udp dport 5005 reject");
  const Address at = TwoNetworks::ipv4(Side::Far, kPort);
  const Outcome sent = start(Side::Near, servo(at)).wait();
  EXPECT_EQ(sent.exit_code, 0) << sent.err;
  EXPECT_NE(sent.out.find("commands not sent"), std::string::npos) << sent.out;
  EXPECT_EQ(sent.out.find("commands not sent      0"), std::string::npos) << sent.out;
}

// The switch flies with the vehicle; the companion is on the other end of the cable.
TEST_F(ServoNetwork, ASwitchOnTheVehicleSaysZeroWhenTheCableIsPulledAndObeysAgainAfter) {
  render(200);
  std::optional<FlightListener> flight;
  networks_->stand(Side::Far, [&] { flight.emplace(); });
  const Address at = TwoNetworks::ipv4(Side::Far, kPort);
  folder_.write("switch.yaml", "links:\n  - {name: autopilot, role: flight, url: \"" +
                                   to_string(flight->local()) +
                                   "\"}\n  - {name: companion, role: vision, url: "
                                   "\"udp-listen://10.77.0.2:5005\"}\n");
  const Program running = start(Side::Far, {"switch", "switch.yaml"});
  auto words = servo(at);
  words.emplace_back("--real-time");
  const Program companion = start(Side::Near, words);
  ASSERT_TRUE(flight->moves(0));
  const double fault_s = monotonic_s();
  networks_->unplug();
  const double pulled_s = monotonic_s();  // the command that pulls it takes its time
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  const double zero_s = flight->lasting_zero_s(fault_s);
  std::printf("cable pulled between two computers: first zero after %.3f s\n", zero_s - pulled_s);
  EXPECT_LE(zero_s - pulled_s, kZeroBound_s);
  EXPECT_LT(monotonic_s() - flight->heard().back().time_s, kSetpointPeriod_s + kScheduling_s);
  networks_->plug();
  EXPECT_TRUE(flight->moves(monotonic_s()));
  EXPECT_EQ(flight->refused(), 0);
}

}  // namespace
}  // namespace kestrel::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const std::string why_not = kestrel::test::TwoNetworks::why_not();
  if (!why_not.empty()) {
    std::printf("network_test: skipped: %s\n", why_not.c_str());
    return 77;
  }
  return RUN_ALL_TESTS();
}
