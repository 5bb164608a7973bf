// The program as its users meet it: arguments in, files, words and exit codes out.
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "kestrel/io/run_log.hpp"

#include "cli/program.hpp"
#include "cli/rendered_sequence.hpp"
#include "support/temp_folder.hpp"

namespace kestrel::test {
namespace {

namespace fs = std::filesystem;
using testing::Test;

class Cli : public Test {
 protected:
  /// A sequence of this many frames in <folder>/frames.
  void render(int frames) { sequence_ = rendered_sequence(folder_.path() / "frames", frames); }
  std::vector<std::string> track(std::vector<std::string> more = {}) const {
    std::vector<std::string> all{"track",      "frames/%04d.png", "--roi", sequence_.roi,
                                 "--no-video", "--output",        "out"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  fs::path path(const std::string& name) const { return folder_.path() / name; }

  TempFolder folder_;
  RenderedSequence sequence_;
};

TEST_F(Cli, HelpAndVersionAreNoErrors) {
  const Outcome help = kestrel({"--help"}, folder_.path());
  EXPECT_EQ(help.exit_code, 0);
  for (const char* verb : {"track", "servo", "simulate", "receive", "check", "demo", "evaluate"}) {
    EXPECT_SAYS(help.out, verb);
  }
  const Outcome verb_help = kestrel({"simulate", "--help"}, folder_.path());
  EXPECT_EQ(verb_help.exit_code, 0);
  EXPECT_SAYS(verb_help.out, "--seed");
  EXPECT_EQ(kestrel({"--version"}, folder_.path()).exit_code, 0);
}

TEST_F(Cli, WrongUsageIsExitCodeTwoAndNamesTheArgument) {
  EXPECT_EQ(kestrel({}, folder_.path()).exit_code, 2);
  const Outcome unknown = kestrel({"track", "x", "--rio", "1,2,3,4"}, folder_.path());
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_SAYS(unknown.err, "--rio");
  const Outcome half = kestrel({"track", "x", "--roi", "1,2,3"}, folder_.path());
  EXPECT_EQ(half.exit_code, 2);
  EXPECT_SAYS(half.err, "1,2,3");
}

TEST_F(Cli, TracksARenderedSequenceToSubpixel) {
  render(8);
  const Outcome outcome = kestrel(track({"--truth", "frames/truth.csv"}), folder_.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_SAYS(outcome.out, "within 1 px");
  EXPECT_SAYS(outcome.out, "run folder: out");
  const LogFile log = read_log(path("out/run.csv"));
  ASSERT_EQ(log.rows.size(), 8u);
  // The rendered motion is exact; SIFT places 50 and more keypoints to about 0.3 px each, so the
  // corners come to well under a pixel.
  for (const double error : log.extra("corner_error_px")) EXPECT_LT(error, 1);
  EXPECT_TRUE(fs::exists(path("out/report.html")));
  EXPECT_TRUE(fs::exists(path("out/summary.json")));
}

TEST_F(Cli, NeverWritesIntoAnExistingRunFolder) {
  render(2);
  ASSERT_EQ(kestrel(track(), folder_.path()).exit_code, 0);
  const std::string first = read(path("out/run.csv"));
  ASSERT_EQ(kestrel(track(), folder_.path()).exit_code, 0);
  EXPECT_EQ(read(path("out/run.csv")), first);
  EXPECT_EQ(read(path("out-2/run.csv")), first);  // and the same input gives the same bytes
}

TEST_F(Cli, ACorruptImageIsSkippedCountedAndNamed) {
  render(6);
  std::ofstream(path("frames/0003.png"), std::ios::trunc) << "half an ima";
  const Outcome outcome = kestrel(track(), folder_.path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_SAYS(outcome.err, "0003.png");
  const LogFile log = read_log(path("out/run.csv"));
  ASSERT_EQ(log.rows.size(), 5u);
  EXPECT_EQ(log.rows[2].frame, 2);
  EXPECT_EQ(log.rows[3].frame, 4);
  EXPECT_SAYS(read(path("out/summary.json")), "\"frames_skipped\": 1");
  EXPECT_SAYS(read(path("out/report.html")), "0003.png");
}

TEST_F(Cli, SaysWhatIsMissing) {
  const Outcome missing =
      kestrel({"track", "nowhere/%04d.png", "--roi", "0,0,64,64"}, folder_.path());
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_SAYS(missing.err, "nowhere");
  fs::create_directories(path("empty"));
  const Outcome empty = kestrel({"track", "empty", "--roi", "0,0,64,64"}, folder_.path());
  EXPECT_EQ(empty.exit_code, 1);
  EXPECT_SAYS(empty.err, "empty");
  EXPECT_FALSE(fs::exists(path("runs"))) << "a run that never began leaves nothing";
}

TEST_F(Cli, RefusesATemplateThatCannotBeTracked) {
  render(2);
  const auto with_roi = [&](const char* roi) {
    return kestrel({"track", "frames/%04d.png", "--no-video", "--roi", roi}, folder_.path());
  };
  const Outcome outside = with_roi("300,200,100,100");
  EXPECT_EQ(outside.exit_code, 1);
  EXPECT_SAYS(outside.err, "320");
  EXPECT_EQ(with_roi("0,0,8,8").exit_code, 1);
  cv::imwrite(path("frames/0000.png").string(), cv::Mat(240, 320, CV_8UC1, cv::Scalar(128)));
  const Outcome flat = with_roi("40,40,120,120");
  EXPECT_EQ(flat.exit_code, 1);
  EXPECT_SAYS(flat.err, "texture");
}

TEST_F(Cli, WithoutRectangleAndDisplayItAsksForOne) {
  render(1);
  Program program({"track", "frames/%04d.png"}, folder_.path(), {"DISPLAY="});
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_SAYS(outcome.err, "--roi");
}

TEST_F(Cli, AnOutputThatCannotBeWrittenIsSaid) {
  render(1);
  std::ofstream(path("file")) << "in the way";
  const Outcome outcome = kestrel(
      {"track", "frames/%04d.png", "--roi", sequence_.roi, "--output", "file/out"}, folder_.path());
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_SAYS(outcome.err, "file/out");
}

TEST_F(Cli, CtrlCLeavesACompleteRunFolder) {
  render(120);
  Program program(track(), folder_.path());
  while (!fs::exists(path("out/run.csv")) || fs::file_size(path("out/run.csv")) < 4000) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  program.signal(SIGINT);
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.exit_code, 130);
  const LogFile log = read_log(path("out/run.csv"));
  EXPECT_FALSE(log.was_interrupted);
  EXPECT_GT(log.rows.size(), 0u);
  EXPECT_LT(log.rows.size(), 120u);
  EXPECT_SAYS(read(path("out/summary.json")), "interrupted");
  EXPECT_SAYS(read(path("out/report.html")), "</html>");
}

TEST_F(Cli, ChecksTheFilesItComesWith) {
  std::vector<std::string> words{"check"};
  for (const char* file : {"tasks/comic.yaml", "tasks/hover.yaml", "calib/mount_forward.yaml",
                           "calib/mount_down.yaml", "calib/comic.xml", "sequences/comic.yaml"}) {
    words.push_back((fs::path(KESTREL_SOURCE_DIR) / file).string());
  }
  const Outcome outcome = kestrel(words, folder_.path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_SAYS(outcome.out, "the camera looks forward");
  EXPECT_SAYS(outcome.out, "the camera looks down");
  EXPECT_SAYS(outcome.out, "6 of 6 files are good");
}

TEST_F(Cli, CheckDrawsTheMountAndSaysWhatTheVehicleDoes) {
  const fs::path source = KESTREL_SOURCE_DIR;
  std::ofstream(path("down.yaml")) << "preset: down\n";
  const Outcome outcome = kestrel(
      {"check", (source / "tasks/hover.yaml").string(), "down.yaml", "--output", "drawings"},
      folder_.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_SAYS(outcome.out, "target to the right in the image -> the vehicle moves right");
  EXPECT_SAYS(outcome.out, "target lower in the image -> the vehicle moves down");
  EXPECT_SAYS(outcome.out, "target lower in the image -> the vehicle moves backward");
  EXPECT_SAYS(read(path("drawings/hover_mount.svg")), "From its right side");
  EXPECT_SAYS(read(path("drawings/down_mount.svg")), "unknown, 60 x 45 degrees");
}

TEST_F(Cli, CheckNamesFileLineAndKey) {
  const std::string good = read(fs::path(KESTREL_SOURCE_DIR) / "tasks/hover.yaml");
  const fs::path calib = fs::path(KESTREL_SOURCE_DIR) / "calib";
  const auto check = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find("../calib"), 8, calib.string());
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    std::ofstream(path("task.yaml")) << text;
    const Outcome outcome = kestrel({"check", "task.yaml"}, folder_.path());
    EXPECT_EQ(outcome.exit_code, 1) << outcome.out;
    return outcome.err;
  };
  EXPECT_SAYS(check("gain_per_s", "gain_per_second"), "task.yaml:15: servo.gain_per_second");
  EXPECT_SAYS(check("0.5, freedom", "half, freedom"), "gain_per_s");
  EXPECT_SAYS(check("noise_grey: 2", "noise_grey: -2"), "noise");
  EXPECT_SAYS(check("heading_deg: -12", "heading_degrees: -12"), "heading_degrees");
  const std::string mount = calib.string() + "/mount_forward.yaml";
  std::ofstream(path("mount.yaml")) << "translation_m: [0, 0, 0]\n"
                                       "rotation: [1, 0, 0, 0, 1, 0, 0, 0, 1.2]\n";
  const Outcome outcome = kestrel({"check", "mount.yaml"}, folder_.path());
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_SAYS(outcome.err, "mount.yaml:2");
  EXPECT_SAYS(outcome.err, "rotation");
}

TEST_F(Cli, ACameraOfAnotherResolutionIsRefused) {
  render(2);
  const Outcome outcome =
      kestrel(track({"--camera", (fs::path(KESTREL_SOURCE_DIR) / "calib/comic.xml").string(),
                     "--size", "0.2", "0.2"}),
              folder_.path());
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_SAYS(outcome.err, "384");
  EXPECT_SAYS(outcome.err, "320");
}

TEST_F(Cli, EachFrameOfAServoRunReachesTheReceiver) {
  render(10);
  std::ofstream(path("task.yaml"))
      << "source: images:frames/%04d.png\nsink: udp://127.0.0.1:14555\nrate_hz: 10\n"
         "camera: {intrinsics_px: [300, 300, 159.5, 119.5], size_px: [320, 240], "
         "body_from_camera: {translation_m: [0, 0, 0], rpy_deg: [90, 0, 90]}}\n"
         "target: {width_m: 1, height_m: 1, template_px: ["
      << sequence_.roi << "]}\n"
      << "goal_camera_from_target: {translation_m: [0, 0, 2], rpy_deg: [0, 0, 0]}\n"
         "servo: {gain_per_s: 0.5}\n";
  Program receiver({"receive", "udp://127.0.0.1:14555", "--count", "11", "--duration", "20",
                    "--log", "commands.csv"},
                   folder_.path());
  while (!fs::exists(path("commands.csv"))) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  const Outcome servo =
      kestrel({"servo", "task.yaml", "--no-video", "--output", "out"}, folder_.path());
  ASSERT_EQ(servo.exit_code, 0) << servo.err;
  const Outcome received = receiver.wait();
  EXPECT_EQ(received.exit_code, 0) << received.err;
  const LogFile log = read_log(path("out/run.csv"));
  ASSERT_EQ(log.rows.size(), 10u);
  std::istringstream commands(read(path("commands.csv")));
  std::string line;
  std::getline(commands, line);
  for (const LogRow& row : log.rows) {  // what was logged is what arrived, as floats
    ASSERT_TRUE(std::getline(commands, line));
    double stamp = -1;
    double forward = 9;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%*d,%*d,%*d,%lf", &stamp, &forward), 2) << line;
    EXPECT_NEAR(stamp, row.stamp_s, 5e-4);  // the wire counts milliseconds
    ASSERT_TRUE(row.decision);
    EXPECT_EQ(forward, double(float(row.decision->sent.forward_m_s)));
  }
  ASSERT_TRUE(std::getline(commands, line));  // the goodbye
  EXPECT_SAYS(line, ",0,0,0,0");
}

}  // namespace
}  // namespace kestrel::test
