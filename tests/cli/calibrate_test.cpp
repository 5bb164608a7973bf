// The verb `calibrate` as its users meet it, on pictures rendered with a known camera.
#include <filesystem>
#include <memory>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "kestrel/geometry/rotation.hpp"
#include "kestrel/io/camera_file.hpp"
#include "kestrel/io/mount_file.hpp"
#include "kestrel/io/video_writer.hpp"

#include "calibration/board_views.hpp"
#include "cli/program.hpp"
#include "cli/video_sender.hpp"
#include "support/temp_folder.hpp"

namespace kestrel::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBoard = "chessboard:7x5:0.03";

class Calibrate : public ::testing::Test {
 protected:
  /// Writes pictures of the board as a straight lens sees it.
  void draw(int count) const {
    Random random("calibrate");
    const Board board = parse_board(kBoard);
    // The poses of a board with one more row and column around: its outer squares, which are needed
    // to find the corners, are whole in the picture too.
    auto poses = usual_poses(parse_board("chessboard:9x7:0.03"), straight(), count, random);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      poses[i].translation += poses[i].rotation * Eigen::Vector3d(0.03, 0.03, 0);
      const std::string name = (i < 10 ? "b0" : "b") + std::to_string(i) + ".png";
      cv::imwrite((folder_ / name).string(), board_picture(board, straight(), poses[i]));
    }
  }
  Outcome run(const std::vector<std::string>& words) const {
    std::vector<std::string> all{"calibrate"};
    all.insert(all.end(), words.begin(), words.end());
    return kestrel(all, folder_.path());
  }

  TempFolder folder_;
};

TEST_F(Calibrate, WritesThreeCameraFilesAReportAndJson) {
  draw(10);
  const Outcome done =
      run({"b%02d.png", "--board", kBoard, "--model", "none", "--output", "out", "--json"});
  ASSERT_EQ(done.exit_code, 0) << done.err << done.out;
  const auto json = nlohmann::json::parse(done.out);
  EXPECT_FALSE(json["refused"].get<bool>());
  EXPECT_EQ(json["views"].size(), 10u);
  EXPECT_FALSE(json["visp"].is_null());
  for (const auto& p : json["parameters"]) {
    const double truth = p["name"] == "fx"   ? 610
                         : p["name"] == "fy" ? 605
                         : p["name"] == "cx" ? 315
                                             : 243;
    // Corners of rendered pictures are off by a few hundredths of a pixel: 0.2 % of the focal
    // length.
    EXPECT_NEAR(p["value"].get<double>(), truth, 1.5) << p["name"];
  }
  for (const char* file : {"camera.xml", "camera_opencv.yaml", "camera_ros.yaml"})
    EXPECT_NEAR(load_camera(folder_ / "out" / file).parameters().px, 610, 1.5) << file;
  EXPECT_SAYS(read(folder_ / "out" / "report.html"), "Where the board was seen");
  EXPECT_SAYS(done.err, "+ b03.png: 35 points");
  const Outcome checked =
      kestrel({"check", "out/camera.xml", "out/camera_ros.yaml"}, folder_.path());
  EXPECT_EQ(checked.exit_code, 0) << checked.err;
}

TEST_F(Calibrate, RefusesTooFewPicturesAndLeavesNoCamera) {
  draw(2);
  const Outcome done = run({".", "--board", kBoard, "--output", "out"});
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_SAYS(done.out, "REFUSED: the board is seen in 2 pictures");
  EXPECT_FALSE(fs::exists(folder_ / "out" / "camera.xml"));
  EXPECT_TRUE(fs::exists(folder_ / "out" / "report.html"));
}

TEST_F(Calibrate, NamesPicturesThatAreOfNoUse) {
  draw(5);
  const std::string whole = read(folder_ / "b00.png");
  folder_.write("c_half.png", whole.substr(0, whole.size() / 2));
  cv::imwrite((folder_ / "d_wall.png").string(), cv::Mat(480, 640, CV_8UC1, cv::Scalar(90)));
  const Outcome done =
      run({".", "--board", kBoard, "--model", "none", "--output", "out", "--no-visp"});
  EXPECT_SAYS(done.err, "- c_half.png: ");
  EXPECT_SAYS(done.err, "- d_wall.png: no board of this kind is found");
  EXPECT_SAYS(done.out, "views");
}

TEST_F(Calibrate, ReadsWhatViSPReads) {
  draw(6);
  folder_.write("default.cfg",
                "BoardSize_Width: 7\nBoardSize_Height: 5\nSquare_Size: 0.03\n"
                "Calibrate_Pattern: CHESSBOARD\nInput: b%02d.png\nTempo: 1\n");
  const Outcome done = run({"--visp-config", "default.cfg", "--model", "none", "--no-visp"});
  EXPECT_EQ(done.exit_code, 0) << done.err << done.out;
  EXPECT_SAYS(done.out, "chessboard:7x5:0.03");
  EXPECT_TRUE(fs::exists(folder_ / "runs" / "calibrate" / "camera.xml"));
}

TEST_F(Calibrate, SaysWhatIsWrongWithTheCommandLine) {
  const auto error = [&](const std::vector<std::string>& words, int code) {
    const Outcome done = run(words);
    EXPECT_EQ(done.exit_code, code) << done.err;
    return done.err + done.out;
  };
  EXPECT_SAYS(error({"none.png", "--board", kBoard}, 1), "none.png: there is no such file");
  EXPECT_SAYS(error({"none%02d.png", "--board", kBoard}, 1), "no pictures there");
  EXPECT_SAYS(error({"."}, 1), "no board: give --board");
  EXPECT_SAYS(error({"--board", kBoard}, 1), "no pictures: give files");
  EXPECT_SAYS(error({".", "--board", "stripes:7x5:0.03"}, 1), "'stripes' is no pattern");
  EXPECT_SAYS(error({".", "--board", kBoard, "--model", "magic"}, 2), "magic");
  EXPECT_SAYS(error({".", "--board", kBoard, "--views", "3"}, 2), "views");
  EXPECT_SAYS(error({"--help"}, 0), "radial-tangential (k1 k2 p1 p2;");
}

TEST_F(Calibrate, ChoosesTheFramesOfAVideoThatShowSomethingNew) {
  draw(10);
  VideoWriter video(folder_ / "v.avi", 6);
  for (int i = 0; i < 10; ++i)
    for (int again = 0; again < 3; ++again)  // a hand that moves and rests
      video.write(cv::imread((folder_ / ("b0" + std::to_string(i) + ".png")).string(), 0));
  video.close();
  const Outcome done = run({video.path().string(), "--board", kBoard, "--model", "none", "--output",
                            "out", "--no-visp", "--json"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const auto json = nlohmann::json::parse(done.out);
  EXPECT_LE(json["views"].size(), 10u);
  EXPECT_GE(json["views"].size(), 6u);
}

TEST_F(Calibrate, HandEyeFindsTheMountOfASimulatedFlight) {
  const fs::path source = KESTREL_SOURCE_DIR;
  std::string task = read(source / "tasks/hover.yaml");
  const auto replace = [&](const std::string& from, const std::string& to) {
    ASSERT_NE(task.find(from), std::string::npos) << from;
    task.replace(task.find(from), from.size(), to);
  };
  replace("../calib", (source / "calib").string());
  // Off to the side, turned away and in a hurry: the flight rolls, pitches and yaws.
  replace("[-9, 1.5, 1.0], heading_deg: -12", "[-9, 3, 1.0], heading_deg: -30");
  replace("gain_per_s: 0.5", "gain_per_s: 1.5");
  folder_.write("task.yaml", task);
  const Outcome flown =
      Program({"simulate", "task.yaml", "--no-video", "--output", "flight"}, folder_.path())
          .wait(120);
  ASSERT_EQ(flown.exit_code, 0) << flown.err;
  const Outcome done = run({"hand-eye", "flight", "--output", "eye"});
  ASSERT_EQ(done.exit_code, 0) << done.err << done.out;
  EXPECT_EQ(done.out.rfind("  mount ", 0), 0u)
      << "ViSP's own words are not to be seen: " << done.out;
  const Mount mount = load_mount(folder_ / "eye" / "mount.yaml");
  const Mount truth = load_mount(source / "calib/mount_forward.yaml");
  // In flight the tracker's errors of neighbouring frames are alike: half a degree, 5 cm at 5 to 9
  // m.
  EXPECT_LT(rotation_vector(truth.rotation.transpose() * mount.rotation).norm(), 0.5 * M_PI / 180);
  EXPECT_LT((mount.translation - truth.translation).norm(), 0.08);
  EXPECT_SAYS(read(folder_ / "eye" / "mount.svg"), "From its right side");
}

TEST_F(Calibrate, HandEyeRefusesAHoverAndLeavesNoMount) {
  std::string rows =
      "stamp_s,roll_deg,pitch_deg,yaw_deg,pose_tx_m,pose_ty_m,pose_tz_m,pose_tux_rad,pose_tuy_rad,"
      "pose_tuz_rad\n";
  for (int i = 0; i < 20; ++i)
    rows += std::to_string(i) + ",0,0," + std::to_string(3 * i) + ",0,0,2,0,0,0\n";
  folder_.write("hover.csv", rows);
  const Outcome done = run({"hand-eye", "hover.csv", "--output", "eye"});
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_SAYS(done.out, "REFUSED: the vehicle was turned about one axis only");
  EXPECT_FALSE(fs::exists(folder_ / "eye"));
  EXPECT_EQ(run({"hand-eye"}).exit_code, 2);
  EXPECT_SAYS(run({"hand-eye", "none.csv"}).err, "none.csv");
}

/// Poses that show all that a guided capture asks for: the four borders, both tilts, near.
std::vector<TargetPose> asked_for(const Board& board) {
  const auto at = [&](double x, double y, double depth_m, double tilt, double turn) {
    return board_pose_at(board, {x, y}, depth_m, {tilt, turn, 0.05});
  };
  return {at(-0.205, 0, 0.45, 0, 0), at(0.22, 0, 0.45, 0, 0), at(0, -0.177, 0.45, 0, 0),
          at(0, 0.167, 0.45, 0, 0),  at(0, 0, 0.5, 0.5, 0),   at(0, 0, 0.5, -0.5, 0),
          at(0, 0, 0.5, 0, 0.5),     at(0, 0, 0.5, 0, -0.5),  at(0, 0, 0.31, 0, 0)};
}

/// Those, over and over, each held for 0.6 s, as a camera on the network sends them.
std::unique_ptr<VideoSender> camera_of(const TempFolder& folder, const std::string& url) {
  const Board board = parse_board(kBoard);
  int number = 0;
  for (const TargetPose& pose : asked_for(board)) {
    const cv::Mat picture = board_picture(board, straight(), pose);
    for (int again = 0; again < 6; ++again) {
      const std::string name = std::to_string(1000 + number++).substr(1) + ".png";
      cv::imwrite((folder / name).string(), picture);
    }
  }
  const std::vector<std::string> input{"-framerate", "10", "-stream_loop",
                                       "-1",         "-i", (folder / "%03d.png").string()};
  const std::vector<std::string> output{"-c:v",   "mjpeg",   "-q:v", "2", "-f",
                                        "mpjpeg", "-listen", "1",    url};
  return std::make_unique<VideoSender>(VideoStream{input, output}, folder.path());
}

TEST_F(Calibrate, GuidesBeforeALiveCameraWithoutAWindow) {
  const std::string url = "http://127.0.0.1:" + std::to_string(free_port()) + "/board";
  const auto camera = camera_of(folder_, url);
  const Outcome done = Program({"calibrate", url, "--board", kBoard, "--model", "none", "--views",
                                "6", "--output", "out", "--no-visp", "--json"},
                               folder_.path())
                           .wait(60);
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_SAYS(done.err, "  now: move the board to the ");
  const auto json = nlohmann::json::parse(done.out);
  EXPECT_GE(json["views"].size(), 6u);
  EXPECT_LE(json["views"].size(), 9u) << "each pose once";
  for (const auto& p : json["parameters"]) {
    if (p["name"] == "fx") {
      EXPECT_NEAR(p["value"].get<double>(), 610, 6) << "of JPEG pictures";
    }
  }
}

// A calibration holds for one size: a live camera is asked for the one that will fly.
TEST_F(Calibrate, AsksALiveCameraForWhatItIsTold) {
  draw(1);
  const auto said = [&](const std::string& input, const std::string& option) {
    const Outcome done =
        run({input, "--board", kBoard, option, "9", "--output", "out", "--no-visp"});
    EXPECT_EQ(done.exit_code, 1);
    return done.err;
  };
  for (const std::string option : {"--rate", "--exposure", "--gain"}) {
    EXPECT_SAYS(said("udp://127.0.0.1:45999", option), "a network stream comes as it is sent");
    EXPECT_SAYS(said(".", option), "are for a live camera");
  }
  EXPECT_SAYS(run({"camera:0", "--board", kBoard, "--trigger", "0"}).err,
              "only a FireWire camera (dc1394) is triggered");
  const std::string standin = std::string("LD_PRELOAD=") + KESTREL_DC1394_STANDIN;
  const Outcome odd = Program({"calibrate", "dc1394", "--board", kBoard, "--size", "1024", "768"},
                              folder_.path(), {standin})
                          .wait(60);
  EXPECT_SAYS(odd.err, "cannot send a picture of 1024x768; it has");
}

}  // namespace
}  // namespace kestrel::test
