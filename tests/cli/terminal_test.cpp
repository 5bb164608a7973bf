// The keys of the terminal in which a flight was started: a pseudo terminal, the real program, and
// what goes out on the wire.
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>

#include <gtest/gtest.h>

#include "cli/page_client.hpp"
#include "cli/program.hpp"
#include "cli/rendered_sequence.hpp"
#include "cli/terminal_program.hpp"
#include "cli/wire_listener.hpp"
#include "support/temp_folder.hpp"

namespace kestrel::test {
namespace {

constexpr double kLong_s = 60;  // never waited out unless something is broken

template <class Condition>
bool comes(const Condition& happens, double within_s = kLong_s) {
  for (const double start_s = now_s(); now_s() - start_s < within_s;) {
    if (happens()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

/// `kestrel servo` on a recording of a minute that goes by at its own rate: a poster that comes
/// and goes, never where the goal wants it.
class Terminal : public testing::Test {
 protected:
  Terminal() {
    const RenderedSequence sequence = rendered_sequence(folder_ / "poster", kFrames);
    std::filesystem::create_directory(folder_ / "frames");
    for (int i = 0; i < 600; ++i) {
      const int at = i % (2 * kFrames);
      const int from = at < kFrames ? at : 2 * kFrames - 1 - at;
      std::filesystem::create_symlink(folder_ / "poster" / picture(from),
                                      folder_ / "frames" / picture(i));
    }
    folder_.write("task.yaml",
                  "source: images:frames/%04d.png\n"
                  "rate_hz: 10\n"
                  "camera: {intrinsics_px: [300, 300, 159.5, 119.5], size_px: [320, 240],\n"
                  "  body_from_camera: {translation_m: [0, 0, 0], rpy_deg: [90, 0, 90]}}\n"
                  "target: {width_m: 0.4, height_m: 0.4, template_px: [" +
                      sequence.roi +
                      "]}\n"
                      "goal_camera_from_target: {translation_m: [0, 0, 2], rpy_deg: [0, 0, 0]}\n");
  }

  static std::string picture(int number) {
    char name[16];
    std::snprintf(name, sizeof name, "%04d.png", number);
    return name;
  }

  std::vector<std::string> servo(const std::vector<std::string>& more = {},
                                 const std::string& output = "run") const {
    std::vector<std::string> words{KESTREL_PROGRAM, "servo",    "task.yaml",
                                   "--real-time",   "--sink",   vehicle_.url(),
                                   "--no-video",    "--output", output};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  void start(const std::vector<std::string>& words) {
    terminal_ = std::make_unique<TerminalProgram>(words, folder_.path());
  }
  bool flies() {
    return comes([&] { return vehicle_.speed() > 0.01; });
  }
  bool stays_still() {
    if (!comes([&] { return vehicle_.speed() == 0; })) return false;
    vehicle_.fastest();
    const long heard = vehicle_.heard();
    return comes([&] { return vehicle_.heard() > heard + 5; }) && vehicle_.fastest() == 0;
  }
  bool prints(const std::string& words) {
    return comes([&] { return terminal_->printed().find(words) != std::string::npos; });
  }

  static constexpr int kFrames = 40;
  const TempFolder folder_;
  WireListener vehicle_;
  std::unique_ptr<TerminalProgram> terminal_;
};

TEST_F(Terminal, SpaceAbortsUntilResetAndStart) {
  start(servo());
  ASSERT_TRUE(flies()) << terminal_->printed();
  EXPECT_TRUE(terminal_->is_single());
  terminal_->type("\x04");  // Ctrl-D and Ctrl-S, slips of a finger, end and hold up nothing
  terminal_->type("\x13");
  EXPECT_TRUE(flies());
  terminal_->cook();  // as a shell does that was not told of the program
  ASSERT_TRUE(comes([&] { return terminal_->is_single(); }));
  const double pressed_s = now_s();
  terminal_->type(" ");
  ASSERT_TRUE(comes([&] { return vehicle_.stopped_s() > pressed_s; }));
  std::printf("space pressed -> first zero on the wire: %.4f s (frames come each 0.1 s)\n",
              vehicle_.stopped_s() - pressed_s);
  EXPECT_TRUE(prints("aborted"));
  EXPECT_TRUE(stays_still());
  terminal_->type("s");
  EXPECT_TRUE(prints("reset first")) << "not back by one key";
  EXPECT_TRUE(stays_still());
  terminal_->type("r");
  EXPECT_TRUE(prints("reset: hover until start"));
  EXPECT_TRUE(stays_still());
  terminal_->type("x");
  terminal_->type("\x1b[A");
  EXPECT_TRUE(stays_still()) << "other keys say nothing";
  terminal_->type("s");
  EXPECT_TRUE(flies());
  EXPECT_EQ(terminal_->printed().find("x\r\n"), std::string::npos) << "keys are not shown";
  terminal_->type("\x03");
  EXPECT_EQ(terminal_->wait(), 130) << "Ctrl-C is what it was";
  EXPECT_TRUE(terminal_->is_as_before());
}

TEST_F(Terminal, WhatIsPastedOnlyStops) {
  start(servo());
  ASSERT_TRUE(flies());
  terminal_->type(" rs");
  EXPECT_TRUE(stays_still());
  terminal_->type("rs");
  EXPECT_TRUE(stays_still());
}

TEST_F(Terminal, IsAsBeforeAfterASignalAndAnError) {
  start(servo());
  ASSERT_TRUE(flies());
  terminal_->signal(SIGQUIT);  // as Ctrl-\ does
  EXPECT_EQ(terminal_->wait(), 128 + SIGQUIT);
  EXPECT_TRUE(terminal_->is_as_before());
  start(servo());
  ASSERT_TRUE(comes([&] { return terminal_->is_single(); }));
  terminal_->signal(SIGTERM);
  EXPECT_EQ(terminal_->wait(), 130);
  EXPECT_TRUE(terminal_->is_as_before());
  // The folder of the run cannot be made: an exception while the keys are listened to.
  start(servo({}, "/proc/nowhere"));
  EXPECT_EQ(terminal_->wait(), 1) << terminal_->printed();
  EXPECT_TRUE(terminal_->is_as_before());
}

TEST_F(Terminal, IsGivenBackWhileTheProgramIsSuspended) {
  // A session's leader is an orphan that no terminal suspends: the program below one is not.
  std::vector<std::string> words{"sh", "-mc", "\"$@\"; echo suspended; sleep 1; fg", "sh"};
  for (const std::string& word : servo()) words.push_back(word);
  start(words);
  ASSERT_TRUE(flies());
  ASSERT_TRUE(comes([&] { return terminal_->is_single(); }));
  terminal_->type("\x1a");
  ASSERT_TRUE(prints("suspended")) << terminal_->printed();
  EXPECT_TRUE(terminal_->is_as_before());
  ASSERT_TRUE(comes([&] { return terminal_->is_single(); })) << "in the foreground again";
  EXPECT_TRUE(flies());
  terminal_->type(" ");
  EXPECT_TRUE(stays_still());
}

TEST_F(Terminal, IsLeftAloneFromTheBackground) {
  std::vector<std::string> words{"sh", "-mc", "\"$@\" & trap \"kill -9 $!\" TERM; wait", "sh"};
  for (const std::string& word : servo()) words.push_back(word);
  start(words);
  ASSERT_TRUE(flies()) << "it is not suspended for touching the terminal";
  EXPECT_TRUE(terminal_->is_as_before());
  terminal_->type(" ");
  const long heard = vehicle_.heard();
  EXPECT_TRUE(comes([&] { return vehicle_.heard() > heard + 10; }));
  EXPECT_TRUE(flies()) << "the key was not for it";
  EXPECT_TRUE(terminal_->is_as_before());
  terminal_->signal(SIGTERM);
  terminal_->wait();
}

TEST_F(Terminal, SpaceAbortsBesideAPageToo) {
  const int port = 20000 + int(getpid() % 3000) * 4;
  // Nobody is at the other end of the hand's link: an abort is one all the same.
  folder_.write("task.yaml", read(folder_ / "task.yaml") + "ground_link: udp://127.0.0.1:9\n");
  start(servo({"--ground", std::to_string(port)}));
  ASSERT_TRUE(prints("#token="));
  ASSERT_TRUE(prints("a hand flies by the ground's own link, udp://127.0.0.1:9"));
  ASSERT_TRUE(prints("until Reset in the page"));
  const std::string printed = terminal_->printed();
  const std::size_t at = printed.find("#token=") + 7;
  PageClient page(port, printed.substr(at, printed.find('\r', at) - at));
  page.give("take");
  page.give("start");
  ASSERT_TRUE(flies());
  terminal_->type(" ");
  EXPECT_TRUE(stays_still());
  const auto status = page.status();
  EXPECT_EQ(status["mode"], "aborted");
  EXPECT_EQ(status["way"]["words"].get<std::string>().find("The switch is not heard"),
            std::string("A hand takes over on the ground's own link. ").size());
  EXPECT_NE(page.give("grip")["words"].get<std::string>().find("not heard"), std::string::npos);
  terminal_->type("r");
  terminal_->type("s");
  EXPECT_TRUE(stays_still());
  EXPECT_EQ(page.status()["mode"], "aborted") << "Reset is the page's";
  page.give("reset");
  page.give("start");
  EXPECT_TRUE(flies());
}

}  // namespace
}  // namespace kestrel::test
