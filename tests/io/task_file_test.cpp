#include "kestrel/io/task_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::filesystem::path kTasks = std::filesystem::path(KESTREL_SOURCE_DIR) / "tasks";

class TaskFile : public ::testing::Test {
 protected:
  TaskFile() {
    folder_.write("seq/s.yaml",
                  "images: i%d.png\ntemplate_px: [1, 2, 30, 40]\ntarget_m: [0.3, 0.4]\n"
                  "camera: ../c.yaml\ntruth: t.csv\nrate_hz: 10\nfirst_frame: 2\nlast_frame: 9\n"
                  "what: w\norigin: o\nlicence: l\n");
    folder_.write("c.yaml",
                  "image_width: 640\nimage_height: 480\n"
                  "camera_matrix: {rows: 3, cols: 3, data: [600, 0, 320, 0, 610, 240, 0, 0, 1]}\n");
  }
  Experiment read(const std::string& text) {
    const Section root = Section::load(folder_.write("t.yaml", text));
    const Experiment experiment = read_experiment(root);
    root.done();
    return experiment;
  }
  std::string error_of(const std::string& text) {
    return test::message_of([&] { read(text); });
  }
  const std::string kMount =
      "body_from_camera: {translation_m: [0.3, 0, 0.1], rpy_deg: [90, 0, 90]}";
  const std::string kGoal =
      "goal_camera_from_target: {translation_m: [0, 0, 2], rpy_deg: [0, 0, 0]}\n";
  const std::string kDescribed =
      "source: sequence:seq/s.yaml\ncamera: {" + kMount + "}\ntarget: {}\n" + kGoal;
  const std::string kOwn =
      "camera: {file: c.yaml, " + kMount + "}\ntarget: {width_m: 0.5, height_m: 0.6}\n" + kGoal;
  test::TempFolder folder_;
};

TEST_F(TaskFile, TakesFromTheDescriptionWhatItDoesNotSay) {
  const Experiment e = read(kDescribed);
  EXPECT_EQ(e.source, "sequence:seq/s.yaml");
  EXPECT_EQ(e.sink, "none");
  EXPECT_EQ(e.ground_link, "");
  EXPECT_EQ(e.task.camera.parameters().px, 600);
  EXPECT_EQ(e.camera_file, folder_.path() / "c.yaml");
  EXPECT_EQ(e.task.target_width_m, 0.3);
  EXPECT_EQ(e.task.target_height_m, 0.4);
  EXPECT_EQ(e.template_px->width, 30);
  EXPECT_EQ(e.truth, folder_.path() / "seq/t.csv");
  EXPECT_EQ(e.sequence->input, (folder_.path() / "seq/i%d.png").string());
  EXPECT_EQ(e.sequence->rate_hz, 10);
  EXPECT_EQ(e.sequence->first_frame, 2);
  EXPECT_EQ(e.sequence->last_frame, 9);
}

TEST_F(TaskFile, PutsItsOwnWordBeforeTheDescriptions) {
  folder_.write("d.yaml",
                "image_width: 640\nimage_height: 480\n"
                "camera_matrix: {rows: 3, cols: 3, data: [700, 0, 320, 0, 610, 240, 0, 0, 1]}\n");
  const Experiment e = read(
      "source: sequence:seq/s.yaml\nsink: udp://127.0.0.1:14550\n"
      "ground_link: udp://127.0.0.1:14601\nground_link_key: hand.key\nrate_hz: 25\nfirst_frame: 3\n"
      "last_frame: 4\ncamera: {file: d.yaml, " +
      kMount + "}\ntarget: {width_m: 1, height_m: 2, template_px: [5, 6, 50, 60]}\n" + kGoal);
  EXPECT_EQ(e.sink, "udp://127.0.0.1:14550");
  EXPECT_EQ(e.ground_link, "udp://127.0.0.1:14601");
  EXPECT_EQ(e.ground_link_key, folder_.path() / "hand.key");
  EXPECT_EQ(e.task.camera.parameters().px, 700);
  EXPECT_EQ(e.task.target_width_m, 1);
  EXPECT_EQ(e.task.target_height_m, 2);
  EXPECT_EQ(e.template_px->u, 5);
  EXPECT_EQ(e.sequence->rate_hz, 25);
  EXPECT_EQ(e.sequence->first_frame, 3);
  EXPECT_EQ(e.sequence->last_frame, 4);
}

TEST_F(TaskFile, ReadsMountGoalAndOptions) {
  const Experiment e = read(kDescribed +
                            "servo: {gain_per_s: 0.7}\nloss: {hold_s: 0.2}\n"
                            "track: {match: {ratio: 0.7}}\n"
                            "limits: {speed: {forward_m_s: 0.5}}\n"
                            "pose: {corner_noise_px: 0.25}\n");
  EXPECT_TRUE(e.task.body_from_camera.rotation.col(2).isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_EQ(e.task.body_from_camera.translation, Eigen::Vector3d(0.3, 0, 0.1));
  EXPECT_EQ(e.task.goal.translation, Eigen::Vector3d(0, 0, 2));
  EXPECT_TRUE(e.task.goal.rotation.isIdentity());
  EXPECT_EQ(e.task.servo.gain_per_s, 0.7);
  EXPECT_EQ(e.task.loss.hold_s, 0.2);
  EXPECT_EQ(e.task.track.match.ratio, 0.7);
  EXPECT_EQ(e.task.limits.speed.forward_m_s, 0.5);
  EXPECT_EQ(e.task.pose.corner_noise_px, 0.25);
}

TEST_F(TaskFile, OpensImagesAndVideosRelativeToItself) {
  EXPECT_EQ(read("source: images:a/%03d.png\n" + kOwn).sequence->input,
            (folder_.path() / "a/%03d.png").string());
  EXPECT_EQ(read("source: video:../v.mp4\n" + kOwn).sequence->input,
            (folder_.path().parent_path() / "v.mp4").string());
  const Experiment e = read("source: images:/x/%d.png\nrate_hz: 5\n" + kOwn);
  EXPECT_EQ(e.sequence->input, "/x/%d.png");
  EXPECT_EQ(e.sequence->rate_hz, 5);
  EXPECT_FALSE(e.template_px || e.truth);
}

TEST_F(TaskFile, LeavesLiveSourcesAndTheSimulationToTheApp) {
  for (const char* source :
       {"camera:0", "dc1394", "dc1394:0123456789abcdef", "simulation", "http://h/v", "rtsp://h/v",
        "rtp://h:2", "udp://h:1", "sim:127.0.0.1:14570", "sim:./frames"}) {
    const Experiment e = read(std::string("source: ") + source + "\n" + kOwn);
    EXPECT_EQ(e.source, source);
    EXPECT_FALSE(e.sequence.has_value());
  }
  EXPECT_EQ(read("source: rtp:../s.sdp\n" + kOwn).source,
            "rtp:" + (folder_.path().parent_path() / "s.sdp").string());
  EXPECT_EQ(read("source: camera:0\ncapture: {gain: 3}\n" + kOwn).live.capture.gain, 3);
  EXPECT_THAT(error_of("source: camera:0\nrate_hz: 5\n" + kOwn), HasSubstr("rate_hz: is no key"));
}

TEST_F(TaskFile, TakesIntrinsicsInPlaceOfAFile) {
  const Experiment e = read(
      "source: simulation\ncamera: {intrinsics_px: [500, 501, 319.5, 239.5], "
      "size_px: [640, 480], " +
      kMount + "}\ntarget: {width_m: 1, height_m: 1, image: p.png}\n" + kGoal);
  EXPECT_EQ(e.task.camera.parameters().py, 501);
  EXPECT_EQ(e.task.camera.parameters().v0, 239.5);
  EXPECT_EQ(e.task.camera.parameters().width, 640);
  EXPECT_FALSE(e.camera_file.has_value());
  EXPECT_EQ(e.template_image, folder_.path() / "p.png");
}

TEST_F(TaskFile, TakesTheTemplateFromAPictureWhenOneIsNamed) {
  const Experiment e = read("source: sequence:seq/s.yaml\ncamera: {" + kMount +
                            "}\ntarget: {image: p.png}\n" + kGoal);
  EXPECT_EQ(e.template_image, folder_.path() / "p.png");
  EXPECT_FALSE(e.template_px.has_value());  // the description's rectangle is in another picture
}

TEST_F(TaskFile, NamesTheLineOfAMistake) {
  EXPECT_THAT(error_of("source: webcam\n" + kOwn),
              AllOf(HasSubstr("t.yaml:1: source: is 'webcam'"), HasSubstr("camera:N")));
  EXPECT_THAT(error_of("source: 'video:'\n" + kOwn), HasSubstr("t.yaml:1: source: names no file"));
  EXPECT_THAT(error_of("source: sequence:none.yaml\n" + kOwn), HasSubstr("there is no such file"));
  EXPECT_THAT(error_of("source: simulation\nsink: tcp://x\n" + kOwn),
              HasSubstr("t.yaml:2: sink: is 'tcp://x'; give autopilot:udp://HOST:PORT, "
                        "udp://HOST:PORT or none"));
  EXPECT_THAT(error_of("source: simulation\nground_link: tcp://x\n" + kOwn),
              HasSubstr("t.yaml:2: ground_link: is 'tcp://x'; give udp://HOST:PORT"));
  EXPECT_THAT(error_of(kDescribed + "rate_hz: 0\n"), HasSubstr("rate_hz: must be positive"));
  EXPECT_THAT(error_of(kDescribed + "last_frame: 1\n"), HasSubstr("t.yaml:5: last_frame: "));
  EXPECT_THAT(error_of(kDescribed + "servos: {}\n"),
              HasSubstr("t.yaml:5: servos: is no key here; did you mean servo?"));
  EXPECT_THAT(error_of("source: simulation\ncamera: {" + kMount + "}\n" + kGoal),
              HasSubstr("t.yaml:2: camera.file: is missing; name a camera file"));
  EXPECT_THAT(error_of("source: simulation\ncamera: {file: c.yaml}\n"),
              HasSubstr("t.yaml:2: camera.body_from_camera: is missing; say how"));
  EXPECT_THAT(error_of("source: simulation\n"), HasSubstr("t.yaml:1: camera: is missing"));
}

TEST_F(TaskFile, RefusesSizesAndGoalsThatCannotBe) {
  const auto own = [&](const std::string& target, const std::string& goal) {
    return error_of("source: simulation\ncamera: {file: c.yaml, " + kMount + "}\ntarget: {" +
                    target + "}\ngoal_camera_from_target: {" + goal + "}\n");
  };
  const std::string size = "width_m: 1, height_m: 1";
  const std::string goal = "translation_m: [0, 0, 2], rpy_deg: [0, 0, 0]";
  EXPECT_EQ(own(size, goal), "nothing was thrown");
  EXPECT_THAT(own("width_m: 1", goal), HasSubstr("t.yaml:3: target.height_m: is missing"));
  EXPECT_THAT(own("width_m: 0, height_m: 1", goal), HasSubstr("target.width_m: must be positive"));
  EXPECT_THAT(own(size, "translation_m: [0, 0, -2], rpy_deg: [0, 0, 0]"),
              HasSubstr("t.yaml:4: goal_camera_from_target.translation_m: puts the target behind"));
  EXPECT_THAT(own(size, "translation_m: [0, 0, 2], rpy_deg: [180, 0, 0]"), HasSubstr("back"));
  EXPECT_THAT(own(size, "translation_m: [0, 0, 2]"), HasSubstr("rpy_deg: is missing"));
}

TEST_F(TaskFile, RefusesIntrinsicsThatCannotBe) {
  const auto camera = [&](const std::string& keys) {
    return error_of("source: simulation\ncamera: {" + keys + ", " + kMount +
                    "}\ntarget: {width_m: 1, height_m: 1}\n" + kGoal);
  };
  EXPECT_THAT(camera("intrinsics_px: [-5, 5, 1, 1], size_px: [2, 2]"),
              HasSubstr("must be positive"));
  EXPECT_THAT(camera("intrinsics_px: [5, 5, 1], size_px: [2, 2]"),
              HasSubstr("has 3 numbers; give 4"));
  EXPECT_THAT(camera("intrinsics_px: [5, 5, 1, 1], size_px: [2.5, 2]"), HasSubstr("whole pixels"));
  EXPECT_THAT(camera("intrinsics_px: [5, 5, 1, 1], size_px: [2, 2], file: c.yaml"),
              HasSubstr("camera.file: is no key here"));
}

TEST_F(TaskFile, LeavesOtherSectionsToTheApp) {
  const Section root =
      Section::load(folder_.write("t.yaml", kDescribed + "simulation: {wind_m_s: 1}\n"));
  read_experiment(root);
  EXPECT_THAT(test::message_of([&] { root.done(); }), HasSubstr("simulation: is no key here"));
  root.child("simulation").number("wind_m_s");
  EXPECT_NO_THROW(root.done());
}

/// Every task that is shipped is read to its last key, but for the simulation's own. The plans of
/// comparisons and the switch beside them have no source, and readers of their own.
TEST(ShippedTasks, AreRead) {
  int tasks = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kTasks)) {
    if (entry.path().extension() != ".yaml") continue;
    const Section root = Section::load(entry.path());
    if (!root.has("source")) continue;
    EXPECT_NO_THROW(read_experiment(root)) << entry.path();
    ++tasks;
  }
  EXPECT_EQ(tasks, 11);  // the comic page, the hover and nine missions
}

}  // namespace
}  // namespace kestrel
