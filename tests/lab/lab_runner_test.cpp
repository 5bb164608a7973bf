#include "kestrel/lab/lab_runner.hpp"

#include <map>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kestrel/io/text_file.hpp"

#include "lab/made_up_runs.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

namespace fs = std::filesystem;

class LabRunning : public ::testing::Test {
 protected:
  LabRunning() {
    options_.folder = folder_ / "out";
    hooks_.is_interrupted = [] { return false; };
    hooks_.tell = [this](const LabProgress& now) { last_ = now; };
  }
  LabOutcome run() { return run_jobs(jobs_, options_, hooks_); }
  /// Every file but timing.csv, by its name.
  std::map<std::string, std::string> files(const std::string& folder) const {
    std::map<std::string, std::string> texts;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / folder)) {
      if (!entry.is_regular_file() || entry.path().filename() == "timing.csv") continue;
      texts[fs::relative(entry.path(), folder_ / folder).string()] = read_text(entry.path());
    }
    return texts;
  }

  test::TempFolder folder_;
  std::atomic<int> made_{0};
  std::vector<LabJob> jobs_ = test::made_up_jobs(12, &made_);
  LabRunnerOptions options_;
  LabHooks hooks_;
  LabProgress last_;
};

TEST_F(LabRunning, MakesEveryRunInTheOrderOfTheJobs) {
  const LabOutcome outcome = run();
  ASSERT_TRUE(outcome.is_complete());
  ASSERT_EQ(outcome.runs.size(), 12u);
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(outcome.runs[i]->id, jobs_[i].id);
  EXPECT_EQ(last_.finished, 12u);
  EXPECT_EQ(last_.planned, 12u);
  EXPECT_EQ(files("out").size(), 13u);  // finished.jsonl and a trace each
}

TEST_F(LabRunning, TheNumberOfThreadsChangesNoByte) {
  for (const int jobs : {1, 2, 9}) {
    options_.folder = folder_ / std::to_string(jobs);
    options_.jobs = jobs;
    run();
  }
  EXPECT_EQ(files("1"), files("2"));
  EXPECT_EQ(files("1"), files("9"));
}

TEST_F(LabRunning, GoesOnWhereItWasInterrupted) {
  hooks_.is_interrupted = [this] { return made_ >= 5; };
  const LabOutcome cut = run();
  EXPECT_EQ(cut.finished, 5u);
  EXPECT_FALSE(cut.is_complete());
  hooks_.is_interrupted = [] { return false; };
  const LabOutcome whole = run();
  EXPECT_EQ(whole.reused, 5u);
  EXPECT_TRUE(whole.is_complete());
  EXPECT_EQ(made_, 12);
  const auto resumed = files("out");
  options_.folder = folder_ / "fresh";
  run();
  EXPECT_EQ(resumed, files("fresh"));
}

TEST_F(LabRunning, MakesAgainWhatChangedOrWhenAsked) {
  run();
  EXPECT_EQ(run().reused, 12u);
  EXPECT_EQ(made_, 12);
  jobs_[3].inputs = "other";
  EXPECT_EQ(run().reused, 11u);
  EXPECT_EQ(made_, 13);
  options_.earlier = Earlier::Redone;
  EXPECT_EQ(run().reused, 0u);
  EXPECT_EQ(made_, 25);
}

TEST_F(LabRunning, WhatIsNoLongerPlannedIsRemoved) {
  run();
  jobs_.resize(4);
  run();
  EXPECT_EQ(files("out").size(), 5u);
}

TEST_F(LabRunning, ShardsMakeEachRunOnceAndUniteToTheSameBytes) {
  run();
  std::vector<fs::path> shards;
  for (int i = 1; i <= 5; ++i) {
    options_.shard = {i, 5};
    options_.folder = folder_ / ("shard" + std::to_string(i));
    const LabOutcome part = run();
    EXPECT_TRUE(part.is_complete());
    EXPECT_EQ(part.planned, i <= 2 ? 3u : 2u);  // 12 = 3 + 3 + 2 + 2 + 2
    shards.push_back(options_.folder);
  }
  EXPECT_EQ(made_, 24);
  const LabOutcome merged = merge_shards(jobs_, shards, folder_ / "merged");
  EXPECT_TRUE(merged.is_complete());
  EXPECT_EQ(made_, 24);
  EXPECT_EQ(files("out"), files("merged"));
  shards.pop_back();
  EXPECT_EQ(merge_shards(jobs_, shards, folder_ / "fewer").finished, 10u);
}

TEST_F(LabRunning, AShardInTheSameFolderKeepsTheOthers) {
  options_.shard = {1, 2};
  run();
  options_.shard = {2, 2};
  run();
  EXPECT_EQ(files("out").size(), 13u);
}

TEST_F(LabRunning, AFailedRunStopsNoOther) {
  jobs_[4].run = []() -> LabRun { throw std::runtime_error("no such thing"); };
  const LabOutcome outcome = run();
  EXPECT_EQ(outcome.finished, 11u);
  ASSERT_EQ(outcome.failures.size(), 1u);
  EXPECT_EQ(outcome.failures[0].id, jobs_[4].id);
  EXPECT_EQ(outcome.failures[0].reason, "no such thing");
  EXPECT_FALSE(outcome.runs[4]);
}

TEST_F(LabRunning, AFullDiskEndsItWithAWord) {
  fs::create_directories(folder_ / "out/runs");
  folder_.write("out/runs/S0", "in the way");
  EXPECT_THAT(test::message_of([&] { run(); }), ::testing::HasSubstr("runs/S0: cannot write"));
}

TEST_F(LabRunning, RefusesWhatIsOutOfRange) {
  options_.jobs = 0;
  EXPECT_THROW(run(), std::invalid_argument);
  options_.jobs = 1;
  for (const Shard shard : {Shard{0, 2}, Shard{3, 2}, Shard{1, 0}}) {
    options_.shard = shard;
    EXPECT_THROW(run(), std::invalid_argument);
  }
  options_.shard = {};
  jobs_[1].id = jobs_[0].id;
  EXPECT_THAT(test::message_of([&] { run(); }), ::testing::HasSubstr(jobs_[0].id));
}

}  // namespace
}  // namespace kestrel
