// The verbs `explain` and `compare RUN` as their users meet them: on a flight of the simulator.
#include <filesystem>

#include <gtest/gtest.h>

#include "cli/program.hpp"
#include "support/temp_folder.hpp"

namespace kestrel::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTask = R"(source: simulation
sink: none
camera:
  intrinsics_px: [600, 600, 319.5, 239.5]
  size_px: [640, 480]
  body_from_camera: {file: mount.yaml}
target: {width_m: 2.0, height_m: 1.5}
goal_camera_from_target: {translation_m: [0, 0, 5.0], rpy_deg: [0, 0, 0]}
servo: {law: mean, gain_per_s: 0.5, freedom: four}
simulation: {duration_s: 4}
)";

class Explain : public ::testing::Test {
 protected:
  Explain() {
    folder_.write("task.yaml", kTask);
    folder_.write("mount.yaml", read(fs::path(KESTREL_SOURCE_DIR) / "calib/mount_forward.yaml"));
  }
  Outcome run(const std::vector<std::string>& words) const {
    return kestrel(words, folder_.path());
  }
  /// Flies the task into the folder "flight".
  void fly() const {
    const Outcome flown = run({"simulate", "task.yaml", "--output", "flight", "--no-video"});
    ASSERT_TRUE(fs::exists(folder_.path() / "flight" / "run.csv")) << flown.err;
  }

  TempFolder folder_;
};

TEST_F(Explain, SaysWhatATaskPromises) {
  const Outcome good = run({"explain", "task.yaml"});
  EXPECT_EQ(good.exit_code, 0) << good.err;
  for (const char* topic : {"jacobian", "noise", "gain", "sign", "start"}) {
    EXPECT_SAYS(good.out, "fine  " + std::string(topic));
  }
  std::string fast(kTask);
  fast.replace(fast.find("0.5, freedom"), 3, "4.0");
  folder_.write("task.yaml", fast);
  const Outcome late = run({"explain", "task.yaml", "--latency", "0.3"});
  EXPECT_EQ(late.exit_code, 0) << late.err;
  EXPECT_SAYS(late.out, "fault gain");
  EXPECT_SAYS(late.out, "do: set gain_per_s to");
}

TEST_F(Explain, SaysWhatARunShows) {
  fly();
  const Outcome said = run({"explain", "flight"});
  EXPECT_EQ(said.exit_code, 0) << said.err;
  EXPECT_SAYS(said.out, "the run\n");
  EXPECT_SAYS(said.out, "its task\n");
  EXPECT_SAYS(said.out, "commands down moved the image");
  const Outcome json = run({"explain", "flight", "--json"});
  EXPECT_SAYS(json.out, "\"topic\": \"seen\"");
  EXPECT_EQ(json.out.front(), '[');
}

TEST_F(Explain, NamesWhatCannotBeExplained) {
  const Outcome none = run({"explain", "nothing.yaml"});
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_SAYS(none.err, "nothing.yaml");
  folder_.write("folder/run.csv", "frame,stamp_s\n");
  const Outcome bare = run({"explain", "folder"});
  EXPECT_EQ(bare.exit_code, 1);
  EXPECT_SAYS(bare.err, "--task FILE");
  EXPECT_EQ(run({"explain", "task.yaml", "--rate", "0"}).exit_code, 2);
  EXPECT_EQ(run({"explain"}).exit_code, 2);
}

TEST_F(Explain, ARunGoesThroughOtherLaws) {
  fly();
  const Outcome all = run({"compare", "flight"});
  EXPECT_EQ(all.exit_code, 0) << all.err;
  EXPECT_SAYS(all.out, "pbvs_ct");
  const std::string page = read(folder_.path() / "flight/laws/index.html");
  EXPECT_SAYS(page, "<svg");
  const Outcome two = run({"compare", "flight", "--laws", "mean,des", "--output", "two"});
  EXPECT_EQ(two.exit_code, 0) << two.err;
  const std::string rows = read(folder_.path() / "two/replay.csv");
  EXPECT_SAYS(rows, "law,frame,time_s,wanted_forward_m_s");
  EXPECT_SAYS(rows, "\ndes,");
  EXPECT_EQ(rows.find("\ncur,"), std::string::npos);
  // The law that flew wants what it wanted.
  EXPECT_SAYS(two.out, "mean");
  EXPECT_SAYS(two.out, "0.000");
  run({"compare", "flight", "--laws", "mean,des", "--output", "again"});
  EXPECT_EQ(rows, read(folder_.path() / "again/replay.csv"));
  EXPECT_EQ(run({"compare", "flight", "--laws", "best"}).exit_code, 2);
}

}  // namespace
}  // namespace kestrel::test
