// The template drawn with the mouse, in a real window on a virtual display.
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "cli/program.hpp"
#include "cli/rendered_sequence.hpp"
#include "support/temp_folder.hpp"

namespace kestrel::test {
namespace {

bool has_command(const std::string& name) {
  return std::system(("command -v " + name + " >/dev/null 2>&1").c_str()) == 0;
}

/// An X server of our own; display() is empty when it did not come up.
class VirtualDisplay {
 public:
  explicit VirtualDisplay(const std::filesystem::path& folder) {
    const std::string number = (folder / "display").string();
    const std::string pid = (folder / "pid").string();
    std::system(
        ("Xvfb -displayfd 7 -screen 0 1024x768x24 7>" + number + " 2>/dev/null & echo $! >" + pid)
            .c_str());
    for (int tries = 0; tries < 500 && display_.empty(); ++tries) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      std::ifstream in(number);
      if (std::getline(in, display_) && !in.eof())
        display_ = ":" + display_;
      else
        display_.clear();
    }
    std::ifstream(pid) >> pid_;
  }
  ~VirtualDisplay() {
    if (pid_ > 0) kill(pid_, SIGTERM);
  }
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;
  const std::string& display() const { return display_; }

 private:
  std::string display_;
  int pid_ = 0;
};

/// Clicks at a place of the window with this title.
bool click(const std::string& display, int x, int y, int button) {
  const std::string command =
      "DISPLAY=" + display +
      " xdotool search --sync --onlyvisible --name Kestrel mousemove --window "
      "%1 " +
      std::to_string(x) + " " + std::to_string(y) + " sleep 0.2 click " + std::to_string(button) +
      " sleep 0.2";
  return std::system(command.c_str()) == 0;
}

class WindowTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_command("Xvfb") || !has_command("xdotool")) {
      GTEST_SKIP() << "Xvfb and xdotool are needed to draw in a window";
    }
    rendered_sequence(folder_.path() / "frames", 3);
  }
  TempFolder folder_;
};

TEST_F(WindowTest, TwoClicksAreTheTemplate) {
  const VirtualDisplay screen(folder_.path());
  ASSERT_FALSE(screen.display().empty());
  Program program({"track", "frames/%04d.png", "--no-video", "--output", "out"}, folder_.path(),
                  {"DISPLAY=" + screen.display()});
  ASSERT_TRUE(click(screen.display(), 218, 178, 1));  // the corners in any order
  ASSERT_TRUE(click(screen.display(), 101, 61, 1));
  const Outcome outcome = program.wait(30);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("--roi 101,61,118,118"), std::string::npos) << outcome.err;
}

TEST_F(WindowTest, ARightClickGivesUp) {
  const VirtualDisplay screen(folder_.path());
  ASSERT_FALSE(screen.display().empty());
  Program program({"track", "frames/%04d.png", "--no-video", "--output", "out"}, folder_.path(),
                  {"DISPLAY=" + screen.display()});
  ASSERT_TRUE(click(screen.display(), 100, 100, 3));
  const Outcome outcome = program.wait(30);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("given up"), std::string::npos) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out"));
}

}  // namespace
}  // namespace kestrel::test
