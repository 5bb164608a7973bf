// The template drawn with the mouse, in a real window on a virtual display.
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "calibration/board_views.hpp"
#include "cli/program.hpp"
#include "cli/rendered_sequence.hpp"
#include "cli/video_sender.hpp"
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

/// A board that hangs still before a camera on the network.
std::unique_ptr<VideoSender> board_camera(const TempFolder& folder, const std::string& url) {
  const Board board = parse_board("chessboard:7x5:0.03");
  const Camera camera({600, 600, 319.5, 239.5, 640, 480});
  const TargetPose pose = board_pose_at(board, {0, 0}, 0.5, {0.3, 0.2, 0.1});
  cv::imwrite((folder / "board.png").string(), board_picture(board, camera, pose));
  const std::vector<std::string> input{"-framerate", "10", "-loop",
                                       "1",          "-i", (folder / "board.png").string()};
  const std::vector<std::string> output{"-c:v",   "mjpeg",   "-q:v", "2", "-f",
                                        "mpjpeg", "-listen", "1",    url};
  return std::make_unique<VideoSender>(VideoStream{input, output}, folder.path());
}

TEST_F(WindowTest, AGuidedCaptureEndsWithARightClick) {
  const VirtualDisplay screen(folder_.path());
  ASSERT_FALSE(screen.display().empty());
  const std::string url = "http://127.0.0.1:" + std::to_string(free_port()) + "/board";
  const auto camera = board_camera(folder_, url);
  Program program({"calibrate", url, "--board", "chessboard:7x5:0.03", "--display", "--no-visp"},
                  folder_.path(), {"DISPLAY=" + screen.display()});
  ASSERT_TRUE(click(screen.display(), 100, 100, 3));
  const Outcome outcome = program.wait(30);
  EXPECT_EQ(outcome.exit_code, 1) << "one view is not enough for a camera";
  EXPECT_NE(outcome.out.find("the board is seen in 1 picture"), std::string::npos)
      << outcome.out << outcome.err;
  EXPECT_NE(outcome.err.find("+ frame"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace kestrel::test
