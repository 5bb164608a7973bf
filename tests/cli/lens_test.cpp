// The same flight through lenses of every model: points are undistorted in the loop, so the hover
// is the same. The simulated camera renders with the lens.
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <vector>

#include <gtest/gtest.h>

#include "kestrel/io/camera_writer.hpp"
#include "kestrel/io/run_log.hpp"

#include "cli/program.hpp"
#include "support/temp_folder.hpp"

namespace kestrel::test {
namespace {

namespace fs = std::filesystem;

/// tasks/hover.yaml with a camera file in place of its intrinsics.
std::string hover_with_camera(const TempFolder& folder) {
  const fs::path source = KESTREL_SOURCE_DIR;
  std::string text = read(source / "tasks/hover.yaml");
  const auto replace = [&](const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  };
  replace("intrinsics_px: [600, 600, 319.5, 239.5]", "file: camera_opencv.yaml");
  replace("  size_px: [640, 480]\n", "");
  replace("../calib", (source / "calib").string());
  replace("hold_s: 2", "hold_s: 12");  // until the way there is over
  folder.write("hover.yaml", text);
  return "hover.yaml";
}

/// The largest of the last two seconds, in which the flight counts as a hover.
double last_largest(const std::vector<double>& values) {
  double largest = 0;
  for (std::size_t i = values.size() - 60; i < values.size(); ++i)
    largest = std::max(largest, std::abs(values[i]));
  return largest;
}

class Lenses : public ::testing::TestWithParam<CameraParameters> {};

TEST_P(Lenses, HoverIsTheSame) {
  const TempFolder folder;
  write_camera_files(folder.path(), Camera(GetParam()), "Camera");
  const std::string task = hover_with_camera(folder);
  const Outcome outcome =
      Program({"simulate", task, "--no-video", "--output", "out"}, folder.path()).wait(300);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  const LogFile log = read_log(folder.path() / "out/run.csv");
  const auto position = log.extra("position_error_m");
  const auto yaw = log.extra("true_yaw_rad");
  ASSERT_GT(position.size(), 60u);
  std::printf("held to %.3f m, %.2f deg; %zu frames\n", last_largest(position),
              last_largest(yaw) * 180 / M_PI, position.size());
  EXPECT_GT(position.front(), 3.0);
  // 0.2 % of the distance. Aligned through the lens both hold to 3 mm, which is what two
  // hundredths of a pixel in the corners make of the least visible motion (right against a turn),
  // however strong the lens; with a homography fitted to what it bends to 2 cm.
  EXPECT_LE(last_largest(position), 0.01);
  EXPECT_LE(last_largest(yaw), 0.002);
}

/// The distances of the target that a run's log holds, m.
std::vector<double> distances_m(const fs::path& log) {
  std::vector<double> all;
  for (const LogRow& row : read_log(log).rows)
    if (row.pose) all.push_back(row.pose->translation_m.norm());
  return all;
}

/// The first two seconds of the flight as a recording, which `track` and `servo` see through the
/// same lens.
TEST_P(Lenses, TrackAndServoSeeTheSameDistances) {
  const TempFolder folder;
  write_camera_files(folder.path(), Camera(GetParam()), "Camera");
  const std::string task = hover_with_camera(folder);
  const Outcome flown = Program({"simulate", task, "--no-video", "--output", "flight", "--record",
                                 "film", "--duration", "2"},
                                folder.path())
                            .wait(120);
  EXPECT_EQ(flown.exit_code, 1) << "two seconds are too short to converge";
  std::string servo = read(folder / task);
  servo.resize(servo.find("simulation:\n"));
  servo.replace(servo.find("source: simulation"), 18, "source: sequence:film/hover.yaml");
  folder.write("servo.yaml", servo);
  const auto run = [&](const std::vector<std::string>& words) {
    const Outcome done = Program(words, folder.path()).wait(120);
    EXPECT_EQ(done.exit_code, 0) << done.err;
  };
  run({"servo", "servo.yaml", "--no-video", "--output", "servo"});
  run({"track", "film/hover.yaml", "--no-video", "--output", "track", "--camera",
       "camera_opencv.yaml", "--size", "2.0", "1.5"});
  const std::vector<double> truth = distances_m(folder / "flight/run.csv");
  ASSERT_EQ(truth.size(), 60u);
  for (const char* verb : {"servo", "track"}) {
    const std::vector<double> seen = distances_m(folder.path() / verb / "run.csv");
    ASSERT_EQ(seen.size(), truth.size()) << verb;
    // The recording's template is the whole pixels inside the poster's outline, seen from 9 m: up
    // to 1 of 97 px on each side less than the 1.5 m that the task says, and seen 12 degrees from
    // the side.
    double worst = 0;
    for (std::size_t i = 0; i < seen.size(); ++i)
      worst = std::max(worst, std::abs(seen[i] / truth[i] - 1));
    std::printf("%s: distances to %.3f of the truth\n", verb, worst);
    EXPECT_LE(worst, 0.03) << verb;
  }
  // The film's truth: the outline as the lens shows it, against the nearest homography of ours.
  // Taken for a bent one the template would be 0.9 px off.
  std::vector<double> errors_px = read_log(folder / "track/run.csv").extra("corner_error_px");
  ASSERT_EQ(errors_px.size(), truth.size());
  std::sort(errors_px.begin(), errors_px.end());
  std::printf("track: corners to %.2f px, the worst %.2f\n", errors_px[30], errors_px.back());
  EXPECT_LE(errors_px.back(), 0.6);
}

/// A lens of a usual webcam bends the corners of the image by some 30 px; the fisheye is one of 60
/// degrees here, for the task's field of view, and equidistant but for small terms.
const CameraParameters kNone{600, 600, 319.5, 239.5, 640, 480};
const CameraParameters kRadialTangential{600, 600, 319.5,          239.5,
                                         640, 480, Lens::PlumbBob, {-0.28, 0.08, 5e-4, -4e-4, 0}};
const CameraParameters kKannalaBrandt{
    600, 600, 319.5, 239.5, 640, 480, Lens::KannalaBrandt, {-0.03, 0.005, 0, 0}};

std::string lens_name(const ::testing::TestParamInfo<CameraParameters>& one) {
  const std::array<std::string, 3> names = {"None", "RadialTangential", "KannalaBrandt"};
  return names[one.index];
}

INSTANTIATE_TEST_SUITE_P(Models, Lenses,
                         ::testing::Values(kNone, kRadialTangential, kKannalaBrandt), lens_name);

}  // namespace
}  // namespace kestrel::test
