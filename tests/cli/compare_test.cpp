// The verbs `compare`, `merge` and `laws` as their users meet them.
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <thread>

#include <gtest/gtest.h>

#include "cli/program.hpp"
#include "support/temp_folder.hpp"

namespace kestrel::test {
namespace {

namespace fs = std::filesystem;

class Compare : public ::testing::Test {
 protected:
  Compare() {
    folder_.write("plan.yaml", read(fs::path(KESTREL_SOURCE_DIR) / "tasks/compare_quick.yaml"));
  }
  Outcome compare(std::vector<std::string> words) const {
    words.insert(words.begin(), "compare");
    return kestrel(words, folder_.path());
  }
  fs::path path(const std::string& name) const { return folder_.path() / name; }
  /// Every file of a run folder but timing.csv, by its name.
  std::map<std::string, std::string> files(const std::string& folder) const {
    std::map<std::string, std::string> texts;
    for (const auto& entry : fs::recursive_directory_iterator(path(folder))) {
      if (!entry.is_regular_file() || entry.path().filename() == "timing.csv") continue;
      texts[fs::relative(entry.path(), path(folder)).string()] = read(entry.path());
    }
    return texts;
  }
  void expect_same(const std::string& a, const std::string& b) const {
    const auto left = files(a);
    const auto right = files(b);
    ASSERT_EQ(left.size(), right.size());
    for (const auto& [name, text] : left) {
      ASSERT_EQ(right.count(name), 1u) << name;
      EXPECT_TRUE(text == right.at(name)) << name << " differs";
    }
  }

  TempFolder folder_;
};

TEST_F(Compare, PrintsTheTablesAndLeavesTheFolder) {
  const Outcome outcome = compare({"plan.yaml", "--output", "out"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* words : {"S0_tutorial", "S3_rz90", "own", "mean_fast", "kz2", "noise_px=0.5",
                            "vp3_hh_des", "box", "gain limit"})
    EXPECT_SAYS(outcome.out, words);
  EXPECT_SAYS(outcome.err, "comparison: out");
  EXPECT_EQ(outcome.out, read(path("out/table.txt")));
  for (const char* name :
       {"results.csv", "results.json", "index.html", "timing.csv", "configuration.yaml",
        "starts/box.csv", "basins.csv", "basin_runs.csv", "maps/depth_delay.csv", "margins.csv",
        "runs/S0_tutorial/cur.csv", "runs/S0_tutorial/cur/kz2.csv", "runs/H0/mejias.csv"})
    EXPECT_TRUE(fs::exists(path("out") / name)) << name;
  const std::string trace = read(path("out/runs/own/des.csv"));
  EXPECT_EQ(trace.rfind("step,time_s,error_norm,", 0), 0u);
  EXPECT_EQ(trace.find("nan"), std::string::npos);
  // 4 laws on 3 scenarios, 4 with kz2, 2 with each of two noises, 2 on the helicopter, a head.
  const std::string results = read(path("out/results.csv"));
  EXPECT_EQ(std::count(results.begin(), results.end(), '\n'), 12 + 4 + 4 + 2 + 1);
}

TEST_F(Compare, JsonGoesToStandardOutput) {
  const Outcome outcome = compare({"plan.yaml", "--output", "out", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, read(path("out/results.json")));
  EXPECT_SAYS(outcome.out, "\"k_error\": ");
}

TEST_F(Compare, NeitherThreadsNorShardsChangeAByte) {
  ASSERT_EQ(compare({"plan.yaml", "--jobs", "1", "--output", "one"}).exit_code, 0);
  ASSERT_EQ(compare({"plan.yaml", "--jobs", "3", "--output", "three"}).exit_code, 0);
  expect_same("one", "three");
  for (const char* i : {"1", "2", "3"}) {
    const Outcome shard =
        compare({"plan.yaml", "--shard", std::string(i) + "/3", "--output", std::string("s") + i});
    ASSERT_EQ(shard.exit_code, 0) << shard.err;
    EXPECT_SAYS(shard.err, "kestrel merge");
  }
  const Outcome merged = kestrel({"merge", "all", "s1", "s2", "s3"}, folder_.path());
  ASSERT_EQ(merged.exit_code, 0) << merged.err;
  expect_same("one", "all");
  const Outcome part = kestrel({"merge", "part", "s1", "s3"}, folder_.path());
  EXPECT_EQ(part.exit_code, 1);
  EXPECT_SAYS(part.err, "in none of the shards");
  const Outcome rest = compare({"part/configuration.yaml", "--output", "part"});
  EXPECT_EQ(rest.exit_code, 0);
  EXPECT_SAYS(rest.err, "runs were finished before");
  expect_same("one", "part");
}

// The recipe of tasks/compare.md, with GNU parallel as the scheduler.
TEST_F(Compare, GnuParallelRunsTheShards) {
  if (std::system("parallel --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "no GNU parallel";
  ASSERT_EQ(compare({"plan.yaml", "--output", "one"}).exit_code, 0);
  const std::string command = "cd '" + folder_.path().string() +
                              "' && parallel '" KESTREL_PROGRAM
                              " compare plan.yaml --shard {}/2 --output s{} > log{} 2>&1' ::: 1 2";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const Outcome merged = kestrel({"merge", "all", "s1", "s2"}, folder_.path());
  ASSERT_EQ(merged.exit_code, 0) << merged.err;
  expect_same("one", "all");
}

TEST_F(Compare, PlotWantsADisplay) {
  Program program({"compare", "plan.yaml", "--plot"}, folder_.path(), {"DISPLAY="});
  const Outcome refused = program.wait();
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_SAYS(refused.err, "DISPLAY is not set");
}

TEST_F(Compare, CtrlCKeepsWhatIsFinishedAndTheNextStartGoesOn) {
  const std::string plan = read(path("plan.yaml"));
  folder_.write("plan.yaml", plan.substr(0, plan.find("basins:")) +
                                 "basins:\n  - {name: box, scenario: S0_tutorial, poses: 40}\n");
  const std::vector<std::string> words{"compare", "plan.yaml", "--jobs", "1", "--output", "out"};
  Program program(words, folder_.path());
  const auto has_begun = [&] { return !read(path("out/finished.part.jsonl")).empty(); };
  for (int waited_ms = 0; !has_begun() && waited_ms < 60000; waited_ms += 2) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  ASSERT_TRUE(has_begun());
  program.signal(SIGINT);
  const Outcome outcome = program.wait();
  ASSERT_EQ(outcome.exit_code, 130) << outcome.err;
  EXPECT_SAYS(outcome.err, "the same command goes on from here");
  EXPECT_TRUE(fs::exists(path("out/results.csv")));
  const Outcome resumed = kestrel(words, folder_.path());
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_SAYS(resumed.err, "runs were finished before");
  ASSERT_EQ(compare({"plan.yaml", "--output", "whole"}).exit_code, 0);
  expect_same("out", "whole");
}

TEST_F(Compare, NamesWhatIsWrong) {
  folder_.write("bad.yaml", "laws: [curr]\nscenarios: all\n");
  const Outcome bad = compare({"bad.yaml", "--output", "out"});
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_SAYS(bad.err, "bad.yaml:1: laws: there is no law curr; did you mean cur?");
  EXPECT_FALSE(fs::exists(path("out")));
  EXPECT_EQ(compare({"plan.yaml", "--shard", "3/2"}).exit_code, 2);
  EXPECT_EQ(compare({"plan.yaml", "--shard", "x"}).exit_code, 2);
  EXPECT_EQ(compare({"plan.yaml", "--jobs", "0"}).exit_code, 2);
  EXPECT_EQ(compare({}).exit_code, 2);
  folder_.write("strange/file", "of something else");
  const Outcome strange = compare({"plan.yaml", "--output", "strange"});
  EXPECT_EQ(strange.exit_code, 1);
  EXPECT_SAYS(strange.err, "something else");
  const Outcome merged = kestrel({"merge", "out", "strange"}, folder_.path());
  EXPECT_EQ(merged.exit_code, 1);
  EXPECT_SAYS(merged.err, "configuration.yaml");
}

TEST_F(Compare, WhatCannotBeWrittenIsNamed) {
  folder_.write("out/configuration.yaml", "title: of an earlier start\n");
  folder_.write("out/runs", "in the way");
  const Outcome blocked = compare({"plan.yaml", "--output", "out"});
  EXPECT_EQ(blocked.exit_code, 1);
  EXPECT_SAYS(blocked.err, "out/runs");
  EXPECT_SAYS(blocked.err, "cannot write");
}

TEST_F(Compare, TellsOfTheLaws) {
  const Outcome all = kestrel({"laws"}, folder_.path());
  EXPECT_EQ(all.exit_code, 0);
  for (const char* law : {"cur", "mean_zdes", "2.5d", "decoupled"}) EXPECT_SAYS(all.out, law);
  const Outcome one = kestrel({"laws", "mean"}, folder_.path());
  for (const char* words : {"formula", "needs", "source", "use", "breaks"})
    EXPECT_SAYS(one.out, words);
  EXPECT_EQ(kestrel({"laws", "magic"}, folder_.path()).exit_code, 2);
}

}  // namespace
}  // namespace kestrel::test
