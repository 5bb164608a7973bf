// `kestrel switch` and `kestrel key` as processes, over real sockets of loopback.
#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "kestrel/link/status_server.hpp"
#include "kestrel/link/switch_core.hpp"

#include "cli/program.hpp"
#include "cli/switch_peers.hpp"
#include "support/temp_folder.hpp"

namespace kestrel::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using testing::HasSubstr;

class Switch : public testing::Test {
 protected:
  /// Starts a switch between the autopilot, vision (UDP) and a ground station (TCP).
  void start(const std::string& more_links = "", const std::string& more_keys = "") {
    std::ofstream(folder_ / "switch.yaml")
        << "links:\n"
        << "  - {name: autopilot, role: flight, url: '" << place(LinkKind::UdpClient) << "'}\n"
        << "  - {name: eyes, role: vision, url: 'udp-listen://127.0.0.1:0'}\n"
        << "  - {name: tower, role: ground, url: 'tcp-listen://127.0.0.1:0'}\n"
        << more_links << "status: status\nlog: {file: log.jsonl}\n"
        << more_keys;
    program_ = std::make_unique<Program>(std::vector<std::string>{"switch", "switch.yaml"},
                                         folder_.path());
    ASSERT_TRUE(comes([&] { return !status().is_null(); }));
  }

  std::string place(LinkKind kind) const {
    return to_string(LinkPlace{kind, autopilot_.address()});
  }

  /// Null when the switch does not answer.
  Json status() const {
    try {
      return Json::parse(ask_status(folder_ / "status", kLong_s));
    } catch (const std::runtime_error&) {
      return {};
    }
  }

  /// The other end of a link of the switch.
  LinkPlace end_of(const std::string& link) const {
    const Json now = status();
    for (const Json& each : now["links"]) {
      if (each["name"] != link) continue;
      LinkPlace at = parse_link_place(each["url"].get<std::string>());
      at.kind = is_stream(at.kind) ? LinkKind::TcpClient : LinkKind::UdpClient;
      return at;
    }
    throw std::runtime_error("no link " + link);
  }
  Speaker eyes() const { return {end_of("eyes"), 1, 191}; }
  Speaker tower() const { return {end_of("tower"), 255, 190}; }

  /// True when flight control is asked for this while vision asks for `asked_m_s`.
  bool flies(Speaker& vision, double asked_m_s, double expected_m_s) {
    return comes([&] {
      vision.ask_forward(asked_m_s);
      const auto forward = autopilot_.asked();
      return forward && std::abs(*forward - expected_m_s) < 1e-6;
    });
  }
  /// True when for half a second nothing but zeros reaches flight control, whatever vision asks.
  bool stays_still(Speaker& vision) {
    const auto moves = [&] {
      vision.ask_forward(0.3);
      return std::abs(autopilot_.asked().value_or(0)) > 0;
    };
    return !comes(moves, 0.5);
  }
  bool control_is(const std::string& state) {
    return comes([&] { return status()["control"] == state; });
  }

  TempFolder folder_;
  Autopilot autopilot_{Address{"127.0.0.1", 0}};
  std::unique_ptr<Program> program_;
};

TEST_F(Switch, CarriesSetpointsToTheVehicleAndItsTelemetryBack) {
  start();
  Speaker vision = eyes();
  EXPECT_TRUE(flies(vision, 0.3, 0.3));
  EXPECT_TRUE(control_is("owned"));
  EXPECT_TRUE(comes([&] {
    autopilot_.say(mavlink::AttitudeReport{});
    return vision.hears<mavlink::AttitudeReport>();
  }));
}

TEST_F(Switch, TheEnvelopeHolds) {
  start("", "limits: {speed: {forward_m_s: 0.5}}\n");
  Speaker vision = eyes();
  EXPECT_TRUE(flies(vision, 5, 0.5));
}

TEST_F(Switch, VisionThatFallsSilentIsFollowedByZeros) {
  start();
  Speaker vision = eyes();
  ASSERT_TRUE(flies(vision, 0.3, 0.3));
  EXPECT_TRUE(comes([&] { return autopilot_.asked() == 0.0; }));
  const long before = autopilot_.setpoints();
  EXPECT_TRUE(comes([&] {  // zeros, not silence
    autopilot_.asked();
    return autopilot_.setpoints() > before + 3;
  }));
  EXPECT_TRUE(flies(vision, 0.2, 0.2));
}

TEST_F(Switch, TheOperatorTakesOverAndGivesBack) {
  start();
  Speaker vision = eyes();
  Speaker ground = tower();
  ASSERT_TRUE(flies(vision, 0.3, 0.3));
  ASSERT_TRUE(comes([&] {
    ground.command(std::uint16_t(SwitchControl::TakeOver));
    return status()["control"] == "taken over";
  }));
  EXPECT_TRUE(comes([&] { return autopilot_.asked() == 0.0; }));
  EXPECT_TRUE(stays_still(vision));
  ground.command(std::uint16_t(SwitchControl::Release));
  EXPECT_TRUE(flies(vision, 0.3, 0.3));
}

TEST_F(Switch, AnEmergencyStopOutlivesWhoSetIt) {
  start();
  Speaker vision = eyes();
  ASSERT_TRUE(flies(vision, 0.3, 0.3));
  {
    Speaker ground = tower();
    ASSERT_TRUE(comes([&] {
      ground.command(std::uint16_t(SwitchControl::EmergencyStop));
      return status()["control"] == "stopped";
    }));
  }
  EXPECT_TRUE(comes([&] { return autopilot_.asked() == 0.0; }));
  EXPECT_TRUE(stays_still(vision));
  EXPECT_EQ(status()["control"], "stopped");
  Speaker other = tower();
  ASSERT_TRUE(comes([&] {
    other.command(std::uint16_t(SwitchControl::Reset));
    return status()["control"] != "stopped";
  }));
  EXPECT_TRUE(flies(vision, 0.3, 0.3));
}

TEST_F(Switch, VisionMayNotCommandTheSwitch) {
  start();
  Speaker vision = eyes();
  ASSERT_TRUE(flies(vision, 0.3, 0.3));
  for (int i = 0; i < 10; ++i) vision.command(std::uint16_t(SwitchControl::EmergencyStop));
  EXPECT_TRUE(flies(vision, 0.2, 0.2));
  EXPECT_EQ(status()["control"], "owned");
}

TEST_F(Switch, APeerThatRestartsIsHeardAgain) {
  start("  - {name: more_eyes, role: vision, url: 'tcp-listen://127.0.0.1:0'}\n");
  for (int i = 0; i < 3; ++i) {
    Speaker vision(end_of("more_eyes"), 1, 191);
    EXPECT_TRUE(flies(vision, 0.1 * (i + 1), 0.1 * (i + 1))) << i;
  }
  EXPECT_TRUE(comes([&] { return status()["peers"].size() == 1; }));  // the autopilot alone
}

TEST_F(Switch, WhoConnectsToIsConnectedToAgain) {
  StreamListener listener = StreamListener::bound_to({"127.0.0.1", 0});
  start("  - {name: far, role: telemetry, url: '" +
        to_string(LinkPlace{LinkKind::TcpClient, listener.local()}) + "'}\n");
  for (int i = 0; i < 3; ++i) {
    std::optional<StreamSocket> accepted;
    EXPECT_TRUE(comes([&] { return (accepted = listener.accept()).has_value(); })) << i;
  }
}

TEST_F(Switch, ASlowReaderDelaysNobody) {
  start("  - {name: sleeper, role: telemetry, url: 'tcp-listen://127.0.0.1:0'}\n",
        "vehicle: {system_id: 1, component_id: 1}\n");
  Speaker vision = eyes();
  ASSERT_TRUE(flies(vision, 0.3, 0.3));
  StreamSocket sleeper = StreamSocket::connecting_to(end_of("sleeper").address);
  mavlink::StatusText text;
  text.text.fill('x');
  const auto dropped = [&] {
    const Json now = status();
    for (const Json& peer : now["peers"]) {
      if (peer["link"] == "sleeper" && peer["dropped"] > 0) return true;
    }
    return false;
  };
  ASSERT_TRUE(comes([&] {  // until the kernel's buffers and the queue are full
    for (int i = 0; i < 200; ++i) autopilot_.say(text);
    vision.ask_forward(0.3);
    return dropped();
  }));
  EXPECT_TRUE(flies(vision, 0.2, 0.2));
  EXPECT_TRUE(comes([&] {
    autopilot_.say(mavlink::AttitudeReport{});
    return vision.hears<mavlink::AttitudeReport>();
  }));
}

TEST_F(Switch, SpeaksIpv6) {
  try {
    UdpSocket::bound_to({"::1", 0});
  } catch (const std::runtime_error&) {
    GTEST_SKIP() << "this machine has no IPv6";
  }
  start(
      "  - {name: six, role: vision, url: 'udp-listen://[::1]:0'}\n"
      "  - {name: six_tcp, role: script, url: 'tcp-listen://[::1]:0'}\n");
  Speaker vision(end_of("six"), 1, 191);
  EXPECT_TRUE(flies(vision, 0.3, 0.3));
  Speaker script(end_of("six_tcp"), 1, 193);
  EXPECT_TRUE(comes([&] {
    script.beat();
    return status()["peers"].size() == 3;
  }));
}

TEST_F(Switch, NoiseIsCountedAndGoesNowhere) {
  start();
  Speaker vision = eyes();
  ASSERT_TRUE(flies(vision, 0.3, 0.3));
  UdpSocket stranger = UdpSocket::connected_to(end_of("eyes").address);
  for (int i = 0; i < 50; ++i) {
    const std::vector<std::uint8_t> noise(std::size_t(1 + i), std::uint8_t(0xFD - i % 2));
    stranger.send({noise.data(), noise.size()});
  }
  EXPECT_TRUE(comes([&] { return status()["links"][1]["strangers"] == 50; }));
  EXPECT_TRUE(flies(vision, 0.2, 0.2));
}

TEST_F(Switch, SaysGoodbyeWithZeros) {
  start();
  Speaker vision = eyes();
  ASSERT_TRUE(flies(vision, 0.3, 0.3));
  program_->signal(SIGTERM);
  const Outcome outcome = program_->wait();
  EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
  EXPECT_EQ(autopilot_.asked(), 0.0);
  EXPECT_THAT(outcome.out, HasSubstr("setpoints sent"));
  EXPECT_FALSE(fs::exists(folder_ / "status"));
  std::ifstream log(folder_ / "log.jsonl");
  std::vector<std::string> events;
  for (std::string line; std::getline(log, line);) {
    events.push_back(Json::parse(line)["event"].get<std::string>());
  }
  EXPECT_THAT(events, testing::Contains("connected"));
  EXPECT_EQ(events.back(), "shutdown");
}

TEST_F(Switch, AnswersWhoAsksForItsStatus) {
  start();
  const Outcome words = kestrel({"switch", "--status", "status"}, folder_.path());
  EXPECT_EQ(words.exit_code, 0) << words.err;
  EXPECT_THAT(words.out, HasSubstr("control: idle; owner: nobody"));
  EXPECT_THAT(words.out, HasSubstr("autopilot"));
  const Outcome json = kestrel({"switch", "--status", "status", "--json"}, folder_.path());
  EXPECT_EQ(Json::parse(json.out)["links"].size(), 3u);
  EXPECT_EQ(kestrel({"switch", "--status", "nowhere"}, folder_.path()).exit_code, 1);
  EXPECT_EQ(kestrel({"switch"}, folder_.path()).exit_code, 2);
}

class SwitchTask : public testing::Test {
 protected:
  std::string refusal(const std::string& text) {
    std::ofstream(folder_ / "switch.yaml") << text;
    const Outcome outcome = Program({"switch", "switch.yaml"}, folder_.path()).wait(10);
    EXPECT_EQ(outcome.exit_code, 1) << outcome.out;
    return outcome.err;
  }
  TempFolder folder_;
};

const std::string kFlight = "links:\n  - {name: a, role: flight, url: 'udp://127.0.0.1:9'}\n";

TEST_F(SwitchTask, NamesFileLineAndKey) {
  EXPECT_THAT(refusal(kFlight + "deadmann_s: 1\n"), HasSubstr("switch.yaml:3: deadmann_s"));
  EXPECT_THAT(refusal("links:\n  - {name: a, role: pilot, url: 'udp://127.0.0.1:9'}\n"),
              HasSubstr("switch.yaml:2: links[1].role"));
  EXPECT_THAT(refusal("links:\n  - {name: a, role: flight, url: 'serial:ttyS0'}\n"),
              HasSubstr("tcp-listen://"));
  EXPECT_THAT(refusal("links: []\n"), HasSubstr("flight"));
  EXPECT_THAT(refusal(kFlight + "rate_hz: 0\n"), HasSubstr("rate_hz"));
}

TEST_F(SwitchTask, AKeyThatOthersMayReadIsRefused) {
  const Outcome made = kestrel({"key", "eyes.key"}, folder_.path());
  EXPECT_EQ(made.exit_code, 0) << made.err;
  struct stat found {};
  ASSERT_EQ(::stat((folder_ / "eyes.key").c_str(), &found), 0);
  EXPECT_EQ(found.st_mode & 0777, 0600);
  EXPECT_EQ(kestrel({"key", "eyes.key"}, folder_.path()).exit_code, 1);  // it stays as it is

  const std::string text =
      kFlight + "  - {name: b, role: vision, url: 'udp-listen://127.0.0.1:0', key: eyes.key}\n";
  EXPECT_THAT(refusal(text), HasSubstr("signing_times"));
  fs::permissions(folder_ / "eyes.key", fs::perms(0640));
  EXPECT_THAT(refusal(text), testing::AllOf(HasSubstr("switch.yaml:3: links[2].key"),
                                            HasSubstr("eyes.key"), HasSubstr("600")));
}

}  // namespace
}  // namespace kestrel::test
