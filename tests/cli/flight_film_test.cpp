// A simulated flight kept as a sequence, and what `evaluate` makes of it.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "kestrel/geometry/homography.hpp"
#include "kestrel/io/csv.hpp"
#include "kestrel/io/sequence_file.hpp"
#include "kestrel/io/truth_file.hpp"

#include "cli/program.hpp"
#include "support/temp_folder.hpp"

namespace kestrel::test {
namespace {

namespace fs = std::filesystem;

/// The rows of numbers below a header.
std::vector<std::vector<double>> rows(const fs::path& file) {
  std::istringstream lines(read(file));
  std::vector<std::vector<double>> all;
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    all.emplace_back();
    for (const auto field : csv_fields(line)) all.back().push_back(*csv_number(field));
  }
  return all;
}

fs::path mission(const std::string& name) {
  return fs::path(KESTREL_SOURCE_DIR) / "tasks/missions" / (name + ".yaml");
}

class Record : public testing::Test {
 protected:
  /// Flies and keeps the frames in `film`.
  Outcome fly(const std::string& name, const std::string& duration_s) {
    return Program({"simulate", mission(name).string(), "--seed", "7", "--duration", duration_s,
                    "--no-video", "--output", "out", "--record", "film"},
                   folder_.path())
        .wait(300);
  }
  fs::path film(const std::string& file) const { return folder_.path() / "film" / file; }

  const TempFolder folder_;
};

// Wind, blur, noise and all: found in every frame, and the corners within half a pixel in the
// median, the noise of a hybrid track on a rendered sequence (0.1 px) and the truth's own: the
// stamp is the middle of the exposure, and the camera shakes by 0.03 deg, 0.3 px.
TEST_F(Record, FeedsEvaluate) {
  const Outcome flown = fly("gust", "1.2");
  ASSERT_EQ(flown.exit_code, 1) << flown.err;  // too short to converge
  const Outcome scored =
      Program({"evaluate", "film", "--method", "hybrid", "--output", "scores"}, folder_.path())
          .wait(300);
  ASSERT_EQ(scored.exit_code, 0) << scored.err << scored.out;
  const auto summary = nlohmann::json::parse(read(folder_.path() / "scores/summary.json"));
  ASSERT_EQ(summary["runs"].size(), 1u);
  const auto& run = summary["runs"][0];
  EXPECT_EQ(run["sequence"], "gust_seed_7");
  EXPECT_EQ(run["frames"], 36);
  EXPECT_EQ(run["found"], 36);
  EXPECT_LT(run["median_px"].get<double>(), 0.5) << run;
}

// The homography carries the first frame's corners to each other frame's; the pose, through the
// camera that lies beside it, says the same of the plane: two independent ways to the same pixels.
TEST_F(Record, TruthsAgree) {
  fly("gust", "0.5");
  const SequenceDescription description = load_sequence(film("gust_seed_7.yaml"));
  EXPECT_TRUE(description.camera);
  const Truth truth = load_truth(*description.truth);
  const auto homographies = rows(film("gust_seed_7_homography.csv"));
  const auto poses = rows(film("gust_seed_7_pose.csv"));
  ASSERT_EQ(truth.size(), 15u);
  ASSERT_EQ(homographies.size(), 15u);
  ASSERT_EQ(poses.size(), 15u);
  const PixelBox& box = description.template_px;
  EXPECT_NEAR(truth.at(0)[0].u, box.u, 1e-9);  // the truth starts at the template
  EXPECT_NEAR(truth.at(0)[2].v, box.v + box.height - 1, 1e-9);
  double moved_px = 0;
  for (const auto& h : homographies) {
    Homography H;
    H.H << h[1], h[2], h[3], h[4], h[5], h[6], h[7], h[8], h[9];
    for (std::size_t i = 0; i < 4; ++i) {
      const Pixel carried = H * truth.at(0)[i];
      const Pixel& there = truth.at(std::int64_t(h[0]))[i];
      EXPECT_NEAR(carried.u, there.u, 1e-6);
      EXPECT_NEAR(carried.v, there.v, 1e-6);
      moved_px = std::max(moved_px, std::abs(there.u - truth.at(0)[i].u));
    }
  }
  EXPECT_GT(moved_px, 1);  // or nothing was tested
  EXPECT_NEAR(poses[3][1], 3 / 30.0, 1e-12);
  EXPECT_GT(poses[3][4], 4);  // about 6 m away
}

TEST_F(Record, LeavesOutTheRowsOfWhatIsHidden) {
  fly("loss_and_return", "4.5");  // something stands before the camera from 4 s on
  const Truth truth = load_truth(film("loss_and_return_seed_7_truth.csv"));
  EXPECT_EQ(truth.count(119), 1u);
  EXPECT_EQ(truth.count(121), 0u);
  EXPECT_EQ(rows(film("loss_and_return_seed_7_pose.csv")).size(), 135u);
}

TEST_F(Record, KeepsWhatIsThere) {
  fly("gust", "0.1");
  const Outcome again = fly("gust", "0.1");
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_SAYS(again.err, "is there already");
  EXPECT_FALSE(fs::exists(folder_.path() / "out-2"));  // before anything else was made
}

}  // namespace
}  // namespace kestrel::test
