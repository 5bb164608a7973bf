// The program against its own stand-in for an autopilot, over real sockets.
#include <csignal>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "kestrel/link/socket.hpp"

#include "cli/program.hpp"
#include "support/temp_folder.hpp"

namespace kestrel::test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A port of loopback that was free a moment ago.
std::string free_address() { return to_string(UdpSocket::bound_to({"127.0.0.1", 0}).local()); }

class WithAutopilot : public testing::TestWithParam<const char*> {
 protected:
  std::vector<std::string> stand_in(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"receive", address_, "--autopilot", GetParam(), "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  Outcome jog(const std::vector<std::string>& more) const {
    std::vector<std::string> words = {"jog", "--to", address_, "--seconds", "1"};
    words.insert(words.end(), more.begin(), more.end());
    return Program(words, folder_.path()).wait(60);
  }

  const std::string address_ = free_address();
  const TempFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(Autopilots, WithAutopilot, testing::Values("ardupilot", "px4"),
                         [](const auto& which) { return std::string(which.param); });

TEST_P(WithAutopilot, JogSaysThatEachAxisMovedAsCommanded) {
  Program vehicle(stand_in(), folder_.path());
  const Outcome outcome = jog({"--yes", "--json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_TRUE(json.at("good").get<bool>());
  ASSERT_EQ(json.at("axes").size(), 4u);
  EXPECT_EQ(json.at("axes")[1].at("verdict"), "as commanded");
  EXPECT_THAT(json.at("axes")[1].at("words").get<std::string>(),
              HasSubstr("commanded right 0.30 m/s for 1.0 s: the vehicle moved right"));
  vehicle.signal(SIGINT);
  const Outcome seen = vehicle.wait();
  EXPECT_THAT(seen.out, HasSubstr(std::string(GetParam()) == "px4" ? "OFFBOARD" : "GUIDED"));
}

TEST_P(WithAutopilot, JogAsksFirstAndDoesNothingWithoutAnAnswer) {
  Program vehicle(stand_in(), folder_.path());
  const Outcome outcome = jog({});  // stdin is empty
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("take control"));
  EXPECT_THAT(outcome.err, HasSubstr("nothing was sent"));
  vehicle.signal(SIGINT);
  EXPECT_THAT(vehicle.wait().out, Not(HasSubstr("mode")));
}

TEST_P(WithAutopilot, JogNeverArmsWithoutLeave) {
  Program vehicle(stand_in({"--on-ground"}), folder_.path());
  const Outcome outcome = jog({"--yes"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("not armed"));
  EXPECT_NE(jog({"--yes", "--takeoff", "3"}).exit_code, 0);
  vehicle.signal(SIGINT);
  EXPECT_THAT(vehicle.wait().out, Not(HasSubstr("armed\n")));
}

TEST_P(WithAutopilot, JogTakesOffWithLeave) {
  Program vehicle(stand_in({"--on-ground"}), folder_.path());
  const Outcome outcome = jog({"--yes", "--allow-arming", "--takeoff", "2", "--axes", "right"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("as commanded"));
}

TEST(Jog, RefusesWhatIsNotSmall) {
  const TempFolder folder;
  EXPECT_EQ(kestrel({"jog", "--to", "udp://127.0.0.1:9", "--speed", "3"}, folder.path()).exit_code,
            2);
  EXPECT_EQ(
      kestrel({"jog", "--to", "udp://127.0.0.1:9", "--seconds", "60"}, folder.path()).exit_code, 2);
  EXPECT_EQ(kestrel({"jog"}, folder.path()).exit_code, 2);
}

TEST(Jog, SaysThatNobodyIsThere) {
  const TempFolder folder;
  const Outcome outcome =
      kestrel({"jog", "--to", free_address(), "--yes", "--wait", "0.5"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("no autopilot has been heard"));
}

// The built-in helicopter flies, its commands fly the stand-in: all of them in the envelope, and
// the last word is zero.
TEST_P(WithAutopilot, SimulateFliesAnAutopilotAsItsSink) {
  Program vehicle(stand_in(), folder_.path());
  const Outcome outcome =
      Program({"simulate", std::string(KESTREL_SOURCE_DIR) + "/tasks/hover.yaml", "--no-video",
               "--duration", "6", "--sink", "autopilot:" + address_, "--output", "out"},
              folder_.path())
          .wait(120);
  EXPECT_THAT(outcome.out, HasSubstr("setpoints sent"));
  EXPECT_THAT(outcome.out, HasSubstr("released")) << outcome.out;
  vehicle.signal(SIGINT);
  const Outcome seen = vehicle.wait();
  EXPECT_THAT(seen.out, HasSubstr("obeyed"));
  EXPECT_THAT(seen.out, HasSubstr(std::string(GetParam()) == "px4" ? "OFFBOARD" : "GUIDED"));
}

TEST(AutopilotTask, AKeyThatIsWrongIsNamedWithItsLine) {
  const TempFolder folder;
  std::ifstream hover(std::string(KESTREL_SOURCE_DIR) + "/tasks/hover.yaml");
  std::string text((std::istreambuf_iterator<char>(hover)), std::istreambuf_iterator<char>());
  const std::size_t calib = text.find("../calib");  // as seen from the folder of the tasks
  if (calib != std::string::npos) text.replace(calib, 2, KESTREL_SOURCE_DIR);
  const auto check = [&](const std::string& keys) {
    std::ofstream(folder.path() / "t.yaml") << text << "\nautopilot:\n" << keys;
    return kestrel({"check", "t.yaml"}, folder.path());
  };
  const Outcome good = check(
      "  rate_hz: 20\n  time_to_live_s: 0.2\n  decay_s: 0.1\n  zero_after_s: 0.4\n"
      "  zeros_for_s: 1\n  then: zeros\n  take_control: false\n  allow_arming: false\n"
      "  attitude_hz: 50\n  vehicle: 1\n  component: 191\n");
  EXPECT_EQ(good.exit_code, 0) << good.err;
  EXPECT_THAT(check("  zero_after_s: 0.9\n").err, HasSubstr("zero_after_s: must be"));
  EXPECT_THAT(check("  takeoff_m: 3\n").err, HasSubstr("allow_arming"));
  EXPECT_THAT(check("  thne: zeros\n").err, HasSubstr("thne"));
}

}  // namespace
}  // namespace kestrel::test
