#include "kestrel/eval/bench_store.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "eval/made_up.hpp"
#include "support/random.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// A run with answers of every kind and numbers of every length.
BenchRun motley() {
  test::Random random("store");
  BenchRun run = test::made_up_run(test::made_up_sequence("s", 12), 1);
  run.method = "paper match.ratio=0.7";
  run.learn_s = random.uniform(0, 1);
  run.skipped = {"frame 3: \"quoted\", with a comma", "frame 9: \xff is no UTF-8"};
  for (BenchFrame& frame : run.frames) {
    for (int i = 0; i < 9; ++i)
      frame.answer.image_from_template->H(i / 3, i % 3) = random.normal() * 1e-3;
    frame.time_s = random.uniform(0, 0.1);
    frame.answer.window = {random.uniform(0, 9), random.uniform(0, 9), 1.0 / 3, 7};
  }
  run.frames[4].answer = {};
  run.frames[4].answer.state = "lost";
  return run;
}

class Store : public ::testing::Test {
 protected:
  std::optional<BenchRun> find(const BenchRun& run, const std::string& inputs) const {
    return store_.find(run.sequence, run.method, inputs);
  }
  test::TempFolder folder_;
  BenchStore store_{folder_.path() / "runs"};
  TrackTruth truth_ = test::made_up_sequence("s", 12).truth;
};

TEST_F(Store, GivesBackWhatItKeepsToTheLastBit) {
  const BenchRun run = motley();
  store_.keep(run, truth_, "inputs");
  const auto back = find(run, "inputs");
  ASSERT_TRUE(back);
  EXPECT_EQ(back->method, run.method);
  EXPECT_EQ(back->template_px.width, run.template_px.width);
  EXPECT_EQ(back->skipped.size(), 2u);
  EXPECT_EQ(back->skipped[0], run.skipped[0]);
  EXPECT_NEAR(back->learn_s, run.learn_s, 1e-12);
  ASSERT_EQ(back->frames.size(), run.frames.size());
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const BenchFrame& a = run.frames[i];
    const BenchFrame& b = back->frames[i];
    EXPECT_EQ(a.frame, b.frame);
    EXPECT_EQ(a.answer.state, b.answer.state);
    EXPECT_EQ(a.answer.window.u, b.answer.window.u);
    EXPECT_EQ(a.answer.window.width, b.answer.window.width);
    EXPECT_EQ(a.answer.keypoints, b.answer.keypoints);
    EXPECT_EQ(a.answer.matches, b.answer.matches);
    EXPECT_EQ(a.answer.inliers, b.answer.inliers);
    EXPECT_NEAR(a.time_s, b.time_s, 1e-15);
    ASSERT_EQ(bool(a.answer.image_from_template), bool(b.answer.image_from_template));
    if (!a.answer.image_from_template) continue;
    EXPECT_EQ(a.answer.image_from_template->H, b.answer.image_from_template->H);
  }
}

TEST_F(Store, AnotherInputIsAnotherRun) {
  const BenchRun run = motley();
  store_.keep(run, truth_, "inputs");
  EXPECT_TRUE(find(run, "inputs"));
  EXPECT_FALSE(find(run, "other inputs"));
  EXPECT_FALSE(store_.find(run.sequence, "paper", "inputs"));
  EXPECT_FALSE(store_.find("t", run.method, "inputs"));
}

TEST_F(Store, TheLastOneKeptCounts) {
  BenchRun run = motley();
  store_.keep(run, truth_, "old");
  run.frames.resize(3);
  store_.keep(run, truth_, "new");
  EXPECT_FALSE(find(run, "old"));
  EXPECT_EQ(find(run, "new")->frames.size(), 3u);
}

TEST_F(Store, TimesAreInTheirOwnFileOnly) {
  BenchRun run = motley();
  const fs::path place = store_.folder_of(run.sequence, run.method);
  store_.keep(run, truth_, "inputs");
  const std::string frames = text_of(place / "frames.csv");
  const std::string json = text_of(place / "run.json");
  run.learn_s = 9;
  for (BenchFrame& frame : run.frames) frame.time_s *= 3;
  store_.keep(run, truth_, "inputs");
  EXPECT_EQ(text_of(place / "frames.csv"), frames);
  EXPECT_EQ(text_of(place / "run.json"), json);
}

TEST_F(Store, TimesAreKeptInMilliseconds) {
  BenchRun run = motley();
  run.learn_s = 0.25;
  run.frames.resize(1);
  run.frames[0].time_s = 0.5;
  store_.keep(run, truth_, "inputs");
  EXPECT_EQ(text_of(store_.folder_of(run.sequence, run.method) / "times.csv"),
            "frame,cpu_ms\nlearn,250\n0,500\n");
}

TEST_F(Store, WhatIsDamagedWasNeverKept) {
  const BenchRun run = motley();
  const fs::path place = store_.folder_of(run.sequence, run.method);
  for (const char* name : {"run.json", "frames.csv", "times.csv"}) {
    store_.keep(run, truth_, "inputs");
    ASSERT_TRUE(find(run, "inputs"));
    fs::resize_file(place / name, fs::file_size(place / name) / 2);
    EXPECT_FALSE(find(run, "inputs")) << name;
    fs::remove(place / name);
    EXPECT_FALSE(find(run, "inputs")) << name;
  }
  // A program killed while it wrote leaves only the folder beside.
  fs::path beside = place;
  beside += ".part";
  store_.keep(run, truth_, "inputs");
  fs::rename(place, beside);
  EXPECT_FALSE(find(run, "inputs"));
  store_.keep(run, truth_, "inputs");
  EXPECT_TRUE(find(run, "inputs"));
  EXPECT_FALSE(fs::exists(beside));
}

TEST_F(Store, SaysWhereItCannotWrite) {
  std::ofstream(folder_.path() / "runs") << "in the way";
  const std::string message = test::message_of([&] { store_.keep(motley(), truth_, "inputs"); });
  EXPECT_NE(message.find("runs"), std::string::npos) << message;
}

TEST(FileName, IsSafeAndStaysDistinct) {
  EXPECT_EQ(file_name("comic"), "comic");
  EXPECT_EQ(file_name("paper match.ratio=0.7"), "paper,match.ratio=0.7");
  const std::vector<std::string> names{"",
                                       ".",
                                       "..",
                                       "a/b",
                                       "a_b",
                                       "a b",
                                       "a,b",
                                       ".a",
                                       "_.a",
                                       "a\n",
                                       "\xc3",
                                       std::string(200, 'a'),
                                       std::string(201, 'a')};
  std::vector<std::string> files;
  for (const std::string& name : names) {
    files.push_back(file_name(name));
    EXPECT_EQ(files.back().find('/'), std::string::npos);
    EXPECT_NE(files.back()[0], '.');
    EXPECT_LT(files.back().size(), 200u);
  }
  std::sort(files.begin(), files.end());
  EXPECT_EQ(std::unique(files.begin(), files.end()), files.end());
}

}  // namespace
}  // namespace kestrel
