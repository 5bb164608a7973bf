// A page whose hand has a link of its own to a switch: the real switch, the real program, a vehicle
// that listens, and a script between the law and the hand.
#include <csignal>
#include <cstdio>

#include <gtest/gtest.h>

#include "kestrel/link/command_link.hpp"
#include "kestrel/link/socket.hpp"

#include "cli/ground_visit.hpp"
#include "cli/page_client.hpp"
#include "cli/switch_process.hpp"

namespace kestrel::test {
namespace {

constexpr double kScript_m_s = 0.2;  // to the right

/// A source of setpoints on a link of the switch, twenty times a second.
class Script {
 public:
  explicit Script(const std::string& url) : link_(parse_address(url), {{}, 1, 77}) {
    thread_ = std::thread([this] {
      for (; !done_; std::this_thread::sleep_for(std::chrono::milliseconds(50))) {
        link_.send({0, kScript_m_s, 0, 0}, now_s());
      }
    });
  }
  ~Script() {
    done_ = true;
    thread_.join();
  }
  Script(const Script&) = delete;
  Script& operator=(const Script&) = delete;

 private:
  CommandLink link_;
  std::atomic<bool> done_{false};
  std::thread thread_;
};

class HandAtASwitch : public testing::Test {
 protected:
  explicit HandAtASwitch(SwitchProcess::Hand hand = SwitchProcess::Hand::Plain)
      : switch_(vehicle_.url(), hand) {}

  /// More of the command line.
  virtual std::vector<std::string> more_arguments() { return {}; }

  void SetUp() override {
    const mavlink::SigningKey key = mavlink::random_key();
    mavlink::write_key(folder_ / "token", key);
    ASSERT_TRUE(comes([&] { return !switch_.status().is_null(); }));
    std::vector<std::string> words{"simulate",
                                   KESTREL_SOURCE_DIR "/tasks/hover.yaml",
                                   "--ground",
                                   std::to_string(port_),
                                   "--ground-token",
                                   "token",
                                   "--sink",
                                   switch_.url("eyes"),
                                   "--ground-link",
                                   switch_.url("hand"),
                                   "--no-video",
                                   "--output",
                                   "run"};
    const auto more = more_arguments();
    words.insert(words.end(), more.begin(), more.end());
    program_ = std::make_unique<Program>(words, folder_.path());
    page_ = std::make_unique<PageClient>(port_, hexadecimal(key));
    ASSERT_TRUE(comes([&] { return !page_->status().is_null(); })) << program_->wait(0).err;
    EXPECT_TRUE(says("The switch:"));
    page_->give("take");
  }

  bool says(const std::string& words) {
    return comes([&] {
      const auto status = page_->status();
      return !status.is_null() &&
             status["way"]["words"].get<std::string>().find(words) != std::string::npos;
    });
  }
  bool has_event(const std::string& words) {
    return comes([&] { return page_->status()["events"].dump().find(words) != std::string::npos; });
  }
  bool control_is(const std::string& state) {
    return comes([&] { return switch_.control() == state; });
  }
  bool flies(const std::function<bool(const VelocityCommand&)>& so) {
    return comes([&] { return so(vehicle_.command()); });
  }
  bool flies_by_hand() {
    return flies([](const VelocityCommand& c) { return c.forward_m_s > 0.29 && c.right_m_s == 0; });
  }
  bool flies_by_script() {
    return flies([](const VelocityCommand& c) {
      return c.right_m_s > kScript_m_s - 1e-6 && c.forward_m_s == 0 && c.down_m_s == 0;
    });
  }
  /// Nothing but zeros for twenty commands.
  bool stays_still() {
    if (!flies([](const VelocityCommand& c) { return c.vector().isZero(0); })) return false;
    vehicle_.fastest();
    const long heard = vehicle_.heard();
    return comes([&] { return vehicle_.heard() > heard + 20; }) && vehicle_.fastest() == 0;
  }

  const int port_ = 20000 + int(getpid() % 3000) * 4;
  const TempFolder folder_;
  WireListener vehicle_;
  SwitchProcess switch_;
  std::unique_ptr<Program> program_;
  std::unique_ptr<PageClient> page_;
};

TEST_F(HandAtASwitch, OverrulesAScriptThatOverrulesTheLaw) {
  page_->give("start");
  EXPECT_TRUE(flies([](const VelocityCommand& c) { return c.vector().norm() > 0.05; }));
  const Script script(switch_.url("script"));
  EXPECT_TRUE(flies_by_script()) << "the law does not overrule it";
  EXPECT_TRUE(says("script commands the vehicle"));
  page_->hold(0.3);
  EXPECT_TRUE(flies_by_hand());
  EXPECT_TRUE(control_is("taken over"));
  EXPECT_TRUE(has_event("take-over granted"));
  page_->let_go_silently();
  EXPECT_TRUE(flies_by_script()) << "released";
  EXPECT_TRUE(has_event("release granted"));
  EXPECT_EQ(page_->status()["mode"], "hover") << "the law waits for Start";
}

TEST_F(HandAtASwitch, WhoseProgramIsKilledIsZeroAndStaysSo) {
  page_->hold(0.3);
  ASSERT_TRUE(flies_by_hand());
  const Script script(switch_.url("script"));
  const double killed_s = now_s();
  program_->signal(SIGKILL);
  ASSERT_TRUE(comes([&] { return vehicle_.stopped_s() > killed_s; }));
  std::printf("program killed with the sticks held -> first zero at the vehicle: %.3f s\n",
              vehicle_.stopped_s() - killed_s);
  EXPECT_TRUE(stays_still()) << "taken over: no script has it because a hand died";
  EXPECT_EQ(switch_.control(), "taken over");
}

TEST_F(HandAtASwitch, WhoseProgramEndsIsZeroAndReleases) {
  page_->hold(0.3);
  ASSERT_TRUE(flies_by_hand());
  program_->signal(SIGINT);
  EXPECT_EQ(program_->wait().exit_code, 130);
  EXPECT_TRUE(stays_still());
  EXPECT_EQ(switch_.control(), "hold");
}

TEST_F(HandAtASwitch, AnAbortIsTheSwitchsEmergencyStopAndLatched) {
  const Script script(switch_.url("script"));
  ASSERT_TRUE(flies_by_script());
  EXPECT_TRUE(page_->stop());
  EXPECT_TRUE(control_is("stopped"));
  EXPECT_TRUE(stays_still());
  EXPECT_TRUE(has_event("emergency stop granted"));
  EXPECT_TRUE(says("EMERGENCY STOP"));
  page_->give("reset");
  EXPECT_TRUE(flies_by_script());
  EXPECT_TRUE(page_->stop());
  EXPECT_TRUE(control_is("stopped"));
  program_->signal(SIGKILL);
  program_->wait();
  EXPECT_TRUE(stays_still()) << "it outlives who asked for it";
  EXPECT_EQ(switch_.control(), "stopped");
}

TEST_F(HandAtASwitch, TheRunsLogSaysSticks) {
  page_->hold(0.3);
  ASSERT_TRUE(flies_by_hand());
  program_->signal(SIGINT);
  const Outcome outcome = program_->wait();
  const std::string log = read(folder_ / "run" / "run.csv");
  EXPECT_NE(log.find(",sticks,"), std::string::npos);
  EXPECT_SAYS(outcome.out, "flown by hand");
}

/// Over a link whose frames are signed.
class SignedHandAtASwitch : public HandAtASwitch {
 protected:
  SignedHandAtASwitch() : HandAtASwitch(SwitchProcess::Hand::Signed) {}
  std::vector<std::string> more_arguments() override {
    return {"--ground-link-key", switch_.key_file()};
  }
};

TEST_F(SignedHandAtASwitch, FliesAndStops) {
  page_->hold(0.3);
  EXPECT_TRUE(flies_by_hand());
  EXPECT_TRUE(page_->stop());
  EXPECT_TRUE(control_is("stopped"));
  EXPECT_TRUE(stays_still());
}

/// The same in a browser.
class PageAtASwitch : public GroundVisit {
 protected:
  std::vector<std::string> more_arguments() override {
    if (!comes([&] { return !switch_.status().is_null(); })) return {};
    return {"--sink", switch_.url("eyes"), "--ground-link", switch_.url("hand")};
  }
  SwitchProcess switch_{vehicle_.url()};
};

TEST_F(PageAtASwitch, SaysByWhichWayCommandsGoAndWhatTheSwitchAnswered) {
  take_command();
  EXPECT_TRUE(says("way", "A hand takes over on the ground's own link"));
  browser_->click("start");
  EXPECT_TRUE(says("way", "vision commands the vehicle"));
  browser_->run("document.getElementById('dead_man').scrollIntoView({block: 'center'})");
  browser_->key_down("g");
  browser_->key_up("g");
  browser_->key_down(" ");
  EXPECT_TRUE(says("way", "The hand flies on the ground's own link"));
  EXPECT_TRUE(says("way", "ground commands the vehicle"));
  EXPECT_TRUE(says("events", "take-over granted"));
  browser_->key_up(" ");
  EXPECT_TRUE(says("events", "release granted"));
  browser_->click("abort");
  EXPECT_TRUE(says("way", "EMERGENCY STOP"));
  EXPECT_TRUE(says("events", "emergency stop granted"));
  browser_->click("reset");
  EXPECT_TRUE(says("events", "reset granted"));
  EXPECT_TRUE(is_true("document.getElementById('reset').hidden"));
}

/// A flight whose commands go to an autopilot's stand-in.
class PageAtAnAutopilot : public GroundVisit {
 protected:
  std::vector<std::string> more_arguments() override {
    const std::string url = to_string(UdpSocket::bound_to({"127.0.0.1", 0}).local());
    autopilot_ = std::make_unique<Program>(
        std::vector<std::string>{"receive", url, "--autopilot", "ardupilot", "--quiet"},
        folder_.path());
    return {"--sink", "autopilot:" + url};
  }
  std::unique_ptr<Program> autopilot_;
};

TEST_F(PageAtAnAutopilot, ShowsTheBatteryAndWarnsWhenItIsLow) {
  EXPECT_TRUE(says("link", "Battery"));
  EXPECT_TRUE(says("link", "12.6 V, 20.0 A, 100 %")) << browser_->text("link");
  const auto classes = [&](const std::string& tone) {
    return browser_->run(
        "Views.showLink({sent: [0, 0, 0], facts: [['Battery', '10.6 V, 7 %: LOW', '" + tone +
        "']]}); const d = document.querySelector('#link dd:last-child');"
        "return d.textContent + ' ' + d.className + ' ' + getComputedStyle(d).backgroundColor");
  };
  EXPECT_SAYS(classes("warn"), "LOW warn rgb(74, 59, 8)");
  EXPECT_SAYS(classes(""), "LOW  rgba(0, 0, 0, 0)");
}

}  // namespace
}  // namespace kestrel::test
