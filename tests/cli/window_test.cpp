// The template drawn with the mouse, in a real window on a virtual display.
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "kestrel/io/run_log.hpp"

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
      " timeout 30 xdotool search --sync --onlyvisible --name Kestrel mousemove --window "
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

/// The task of a recording of rendered_sequence; without a template it asks for one.
std::string task_of_recording() {
  return "source: images:frames/%04d.png\n"
         "camera: {intrinsics_px: [300, 300, 159.5, 119.5], size_px: [320, 240],\n"
         "  body_from_camera: {translation_m: [0, 0, 0], rpy_deg: [90, 0, 90]}}\n"
         "target: {width_m: 0.4, height_m: 0.4}\n"
         "goal_camera_from_target: {translation_m: [0, 0, 2], rpy_deg: [0, 0, 0]}\n";
}

bool is_zero(const LogRow& row) { return row.decision->sent.vector().isZero(0); }

/// Waits until there is a window with this title, at most half a minute.
bool has_window(const std::string& display, const std::string& title) {
  return std::system(("DISPLAY=" + display + " timeout 30 xdotool search --sync --name '" + title +
                      "' >/dev/null 2>&1")
                         .c_str()) == 0;
}

/// So many rows of the run's log, at most a minute later.
bool grows(const std::filesystem::path& log, std::size_t rows) {
  for (int tries = 0; tries < 600; ++tries) {
    if (std::filesystem::exists(log) && read_log(log).rows.size() >= rows) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return false;
}

TEST_F(WindowTest, ClicksDrawTheTemplateStartStopAndEndAServoRun) {
  rendered_sequence(folder_ / "frames", 400);
  const VirtualDisplay screen(folder_.path());
  ASSERT_FALSE(screen.display().empty());
  folder_.write("task.yaml", task_of_recording());
  Program program({"servo", "task.yaml", "--no-video", "--display", "--output", "out"},
                  folder_.path(), {"DISPLAY=" + screen.display()});
  ASSERT_TRUE(click(screen.display(), 101, 61, 1));
  ASSERT_TRUE(click(screen.display(), 218, 178, 1));
  ASSERT_TRUE(has_window(screen.display(), "Curves of the run"));
  const auto log = folder_ / "out" / "run.csv";
  ASSERT_TRUE(grows(log, 1));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(read_log(log).rows.size(), 1U) << "it waits for the first click";
  ASSERT_TRUE(click(screen.display(), 50, 50, 1));
  ASSERT_TRUE(grows(log, 20));
  ASSERT_TRUE(click(screen.display(), 50, 50, 1));
  ASSERT_TRUE(grows(log, read_log(log).rows.size() + 20));
  ASSERT_TRUE(click(screen.display(), 50, 50, 3));
  const Outcome outcome = program.wait(30);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_SAYS(outcome.out, "the window was closed");
  const auto rows = read_log(log).rows;
  EXPECT_TRUE(is_zero(rows.front())) << "before the click";
  EXPECT_FALSE(is_zero(rows[10]));
  EXPECT_FALSE(rows[10].decision->wanted.vector().isZero(0));
  EXPECT_TRUE(is_zero(rows.back())) << "after the second one";
}

TEST_F(WindowTest, ClicksStartAndEndASimulatedFlight) {
  const VirtualDisplay screen(folder_.path());
  ASSERT_FALSE(screen.display().empty());
  Program program({"simulate", KESTREL_SOURCE_DIR "/tasks/hover.yaml", "--no-video", "--display",
                   "--output", "out"},
                  folder_.path(), {"DISPLAY=" + screen.display()});
  ASSERT_TRUE(has_window(screen.display(), "Curves of the run"));
  ASSERT_TRUE(click(screen.display(), 50, 50, 1));
  const auto log = folder_ / "out" / "run.csv";
  ASSERT_TRUE(grows(log, 20));
  ASSERT_TRUE(click(screen.display(), 50, 50, 3));
  const Outcome outcome = program.wait(60);
  EXPECT_SAYS(outcome.err, "servoing at");
  EXPECT_SAYS(outcome.out, "the window was closed");
  const auto rows = read_log(log).rows;
  EXPECT_TRUE(is_zero(rows.front()));
  EXPECT_FALSE(is_zero(rows.back()));
}

TEST_F(WindowTest, ClicksHoldAndEndATrackedRecording) {
  const auto sequence = rendered_sequence(folder_ / "frames", 400);
  const VirtualDisplay screen(folder_.path());
  ASSERT_FALSE(screen.display().empty());
  Program program({"track", "frames/%04d.png", "--roi", sequence.roi, "--no-video", "--display",
                   "--output", "out"},
                  folder_.path(), {"DISPLAY=" + screen.display()});
  ASSERT_TRUE(has_window(screen.display(), "Curves of the run"));
  ASSERT_TRUE(click(screen.display(), 50, 50, 1));
  const auto log = folder_ / "out" / "run.csv";
  std::this_thread::sleep_for(std::chrono::milliseconds(200));  // a frame that was on its way
  const std::size_t held = read_log(log).rows.size();
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  EXPECT_EQ(read_log(log).rows.size(), held);
  ASSERT_TRUE(click(screen.display(), 50, 50, 1));
  EXPECT_TRUE(grows(log, held + 5));
  ASSERT_TRUE(click(screen.display(), 50, 50, 3));
  EXPECT_SAYS(program.wait(30).out, "the window was closed");
}

TEST_F(WindowTest, WithoutADisplayNothingBegins) {
  const Outcome outcome =
      Program({"simulate", KESTREL_SOURCE_DIR "/tasks/hover.yaml", "--display", "--output", "out"},
              folder_.path(), {"DISPLAY="})
          .wait(30);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_SAYS(outcome.err, "no display");
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
