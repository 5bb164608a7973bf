// Each mission flown by the program: rigid helicopter, wind, rendered images and the real tracker.
#include <filesystem>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "kestrel/io/csv.hpp"

#include "cli/program.hpp"
#include "support/temp_folder.hpp"

namespace kestrel::test {
namespace {

namespace fs = std::filesystem;

fs::path mission(const std::string& name) {
  return fs::path(KESTREL_SOURCE_DIR) / "tasks/missions" / (name + ".yaml");
}

class Mission : public testing::TestWithParam<const char*> {};

TEST_P(Mission, Passes) {
  const TempFolder folder;
  const Outcome outcome = Program({"simulate", mission(GetParam()).string(), "--seed", "7",
                                   "--no-video", "--output", "out"},
                                  folder.path())
                              .wait(600);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
}

INSTANTIATE_TEST_SUITE_P(Tasks, Mission,
                         testing::Values("approach_and_hold", "camera_down", "camera_left",
                                         "follow_target", "gust", "hover_window", "loss_and_return",
                                         "seed_timing", "yaw_error"),
                         [](const auto& each) { return std::string(each.param); });

TEST(Missions, AreAllFlownAbove) {
  int files = 0;
  for (const auto& file : fs::directory_iterator(mission("x").parent_path())) {
    files += file.path().extension() == ".yaml" ? 1 : 0;
  }
  EXPECT_EQ(files, 9);
}

TEST(Seeds, MakeATable) {
  const TempFolder folder;
  const Outcome outcome = Program({"simulate", mission("yaw_error").string(), "--seeds", "2-3",
                                   "--duration", "0.2", "--no-video", "--output", "out"},
                                  folder.path())
                              .wait(120);
  EXPECT_EQ(outcome.exit_code, 1);  // too short to converge
  EXPECT_SAYS(outcome.out, "0 of 2 converged");
  const auto flights = nlohmann::json::parse(read(folder.path() / "out/flights.json"));
  ASSERT_EQ(flights.size(), 2u);
  EXPECT_EQ(flights[0]["seed"], 2);
  EXPECT_EQ(flights[1]["result"], "timed out");
  EXPECT_TRUE(flights[1]["settled_s"].is_null());
  EXPECT_SAYS(read(folder.path() / "out/flights.csv"), "seed,result,settled_s");
  // Other seeds start elsewhere.
  EXPECT_NE(read(folder.path() / "out/seed_2/trajectory.tum"),
            read(folder.path() / "out/seed_3/trajectory.tum"));
}

TEST(Seeds, AreAskedForPlainly) {
  const TempFolder folder;
  for (const char* seeds : {"3", "3-", "5-2", "1-2x"}) {
    const Outcome outcome =
        kestrel({"simulate", mission("gust").string(), "--seeds", seeds}, folder.path());
    EXPECT_EQ(outcome.exit_code, 2) << seeds;
    EXPECT_SAYS(outcome.err, "--seeds");
  }
}

// The paper's timing with a gain that it does not bear: the loop takes a quarter of the limit,
// which is 0.853/s by the formula for 0.93 s and 0.93 s, predicts, and arrives.
TEST(Timing, LimitsTheGainAndPredicts) {
  const TempFolder folder;
  std::string text = read(mission("seed_timing"));
  const auto gain = text.find("gain_per_s: 0.2");
  text.replace(gain, 15, "gain_per_s: 0.9");
  const auto calib = text.find("../../calib");
  text.replace(calib, 11, (fs::path(KESTREL_SOURCE_DIR) / "calib").string());
  write_text(folder.path() / "task.yaml", text + "timing: {predict: measured}\n");
  const Outcome outcome =
      Program({"simulate", "task.yaml", "--seed", "7", "--no-video", "--output", "out"},
              folder.path())
          .wait(300);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_SAYS(outcome.out, "timing");
  const auto timing = nlohmann::json::parse(read(folder.path() / "out/summary.json"))["timing"];
  EXPECT_NEAR(timing["period_ms"].get<double>(), 930, 1e-6);
  EXPECT_NEAR(timing["capture_to_command_maximum_ms"].get<double>(), 930, 1e-6);
  EXPECT_NEAR(timing["largest_gain_for_this_timing_1_s"].get<double>(), 0.853 / 4, 0.005);
  EXPECT_NEAR(timing["least_gain_used_1_s"].get<double>(), 0.853 / 4, 0.005);
  EXPECT_GT(timing["features_predicted_over_it_percent"].get<double>(), 50);
}

TEST(SimulationFile, SaysWhatDoesNotGoTogether) {
  const TempFolder folder;
  const auto fault = [&](const std::string& lines) {
    std::string text = read(mission("gust"));
    const auto at = text.find("  pass:");
    text.insert(at, lines);
    const auto calib = text.find("../../calib");
    text.replace(calib, 11, (fs::path(KESTREL_SOURCE_DIR) / "calib").string());
    write_text(folder.path() / "task.yaml", text);
    return kestrel({"simulate", "task.yaml", "--duration", "0.1"}, folder.path()).err;
  };
  EXPECT_SAYS(fault("  surface: wall\n  target_on: ground\n"), "surface");
  EXPECT_SAYS(fault("  surface: wall\n  texture: x.png\n"), "goes with `surface: poster`");
  EXPECT_SAYS(fault("  things: [{size_m: [0, 1]}]\n"), "size_m: must be positive");
  EXPECT_SAYS(fault("  things: [{size_m: [1, 1], opacity: 2}]\n"), "opacity");
  EXPECT_SAYS(fault("  target_motion: {sway_period_s: 0}\n"), "sway_period_s");
}

}  // namespace
}  // namespace kestrel::test
