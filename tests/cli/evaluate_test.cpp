// The verb `evaluate` as its users meet it.
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "cli/program.hpp"
#include "cli/rendered_sequence.hpp"
#include "support/markup_check.hpp"
#include "support/temp_folder.hpp"

namespace kestrel::test {
namespace {

namespace fs = std::filesystem;

class Evaluate : public ::testing::Test {
 protected:
  /// A sequence <name>/ with sequence.txt and gt.csv.
  void render(const std::string& name, int frames) {
    const fs::path folder = folder_.path() / name;
    rendered_sequence(folder / "frames", frames);
    fs::rename(folder / "frames/truth.csv", folder / "gt.csv");
    std::ofstream(folder / "sequence.txt")
        << "images: frames/%04d.png\ntemplate_rect: 101 61 218 178\n";
  }
  Outcome evaluate(std::vector<std::string> words) const {
    words.insert(words.begin(), {"evaluate", "--method", "paper"});
    return kestrel(words, folder_.path());
  }
  fs::path path(const std::string& name) const { return folder_.path() / name; }
  /// All that must not depend on the machine, as one text.
  std::string results(const std::string& folder) const {
    std::string all = read(path(folder) / "summary.csv") + read(path(folder) / "summary.json");
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(path(folder) / "runs")) {
      const auto name = entry.path().filename();
      if (name == "frames.csv" || name == "run.json") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) all += read(file);
    return all;
  }

  TempFolder folder_;
};

TEST_F(Evaluate, PrintsTableOneAndWritesThePage) {
  render("drift", 5);
  const Outcome outcome = evaluate({"drift", "--output", "out"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* words : {"window (px)", "SIFT", "matched", "correct (%)", "mean (ms)",
                            "median (ms)", "p95 (ms)", "max (ms)", "drift", "100.0"})
    EXPECT_SAYS(outcome.out, words);
  EXPECT_SAYS(outcome.err, "[1/1] drift, paper: 5 of 5 frames found");
  const std::string summary = read(path("out/summary.csv"));
  // Labels of all five frames, each found: the rendered motion is exact and SIFT is to a pixel.
  EXPECT_SAYS(summary, "drift,paper,,done,,5,0,5,5,100,100,");
  EXPECT_SAYS(read(path("out/summary.json")), "\"within_1px_percent\": 100.0");
  const std::string page = read(path("out/report.html"));
  EXPECT_EQ(markup_fault(page), "");
  EXPECT_SAYS(page, "Table I of the paper");
  const std::string frames = read(path("out/runs/drift/paper/frames.csv"));
  EXPECT_EQ(std::count(frames.begin(), frames.end(), '\n'), 6);
}

TEST_F(Evaluate, SweepsSettingsInEveryCombination) {
  render("drift", 2);
  const Outcome outcome = evaluate({"drift/sequence.txt", "--set", "ransac.seed=1,2", "--set",
                                    "match.ratio=0.2,0.8", "--output", "out"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* name :
       {"paper ransac.seed=1 match.ratio=0.2", "paper ransac.seed=1 match.ratio=0.8",
        "paper ransac.seed=2 match.ratio=0.2", "paper ransac.seed=2 match.ratio=0.8"})
    EXPECT_SAYS(outcome.out, name);
  EXPECT_SAYS(read(path("out/summary.csv")),
              "sequence,method,settings,ransac.seed,match.ratio,end,");
  // A smaller ratio keeps fewer matches, so the setting has reached the tracker.
  EXPECT_NE(read(path("out/runs/drift/paper,ransac.seed=1,match.ratio=0.2/frames.csv")),
            read(path("out/runs/drift/paper,ransac.seed=1,match.ratio=0.8/frames.csv")));
}

TEST_F(Evaluate, TheNumberOfJobsChangesNothing) {
  render("one", 4);
  render("two", 3);
  ASSERT_EQ(evaluate({".", "--jobs", "1", "--output", "a"}).exit_code, 0);
  ASSERT_EQ(evaluate({"one", "two", "--jobs", "2", "--output", "b"}).exit_code, 0);
  EXPECT_GT(results("a").size(), 2000u);
  EXPECT_EQ(results("a"), results("b"));
}

TEST_F(Evaluate, CtrlCKeepsWhatIsFinishedAndTheNextStartGoesOn) {
  render("a_short", 3);
  render("b_long", 60);
  const std::vector<std::string> words{"evaluate", "--method", "paper",    "a_short", "b_long",
                                       "--jobs",   "1",        "--output", "out"};
  Program program(words, folder_.path());
  const auto is_there = [&] { return fs::exists(path("out/runs/a_short/paper/run.json")); };
  for (int waited_ms = 0; !is_there() && waited_ms < 60000; waited_ms += 5) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ASSERT_TRUE(is_there());
  program.signal(SIGINT);
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_SAYS(outcome.err, "interrupted: 1 of 2 runs are finished");
  EXPECT_SAYS(read(path("out/report.html")), "1 of 2");
  EXPECT_FALSE(fs::exists(path("out/runs/b_long/paper")));
  const auto date = fs::last_write_time(path("out/runs/a_short/paper/times.csv"));

  const Outcome resumed = kestrel(words, folder_.path());
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_SAYS(resumed.err, "1 of 2 runs were finished before");
  EXPECT_EQ(fs::last_write_time(path("out/runs/a_short/paper/times.csv")), date);
  ASSERT_EQ(evaluate({"a_short", "b_long", "--output", "whole"}).exit_code, 0);
  EXPECT_EQ(results("out"), results("whole"));
}

TEST_F(Evaluate, WhatIsFinishedIsRunAgainOnlyWhenItChangedOrOnDemand) {
  render("drift", 2);
  const auto reused = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"drift", "--output", "out"};
    words.insert(words.end(), more.begin(), more.end());
    return evaluate(words).err.find("1 of 1 runs were finished before") != std::string::npos;
  };
  EXPECT_FALSE(reused({}));
  EXPECT_TRUE(reused({}));
  EXPECT_FALSE(reused({"--fresh"}));
  EXPECT_FALSE(reused({"--set", "match.ratio=0.7"}));
  EXPECT_TRUE(reused({}));
  std::ofstream(path("drift/sequence.txt"))
      << "images: frames/%04d.png\ntemplate_rect: 101 61 217 178\n";
  EXPECT_FALSE(reused({}));
  EXPECT_TRUE(reused({}));
  fs::remove(path("drift/frames/0001.png"));
  EXPECT_FALSE(reused({}));
}

TEST_F(Evaluate, ATemplateWithoutTextureIsRefusedAndTheOthersGoOn) {
  render("flat", 2);
  render("good", 2);
  for (const char* name : {"flat/frames/0000.png", "flat/frames/0001.png"})
    cv::imwrite(path(name).string(), cv::Mat(240, 320, CV_8UC1, cv::Scalar(128)));
  const Outcome outcome = evaluate({"flat", "good", "--output", "out"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;  // a refusal is a result
  EXPECT_SAYS(outcome.err, "flat, paper: refused: template: too little texture");
  EXPECT_SAYS(outcome.out, "refused");
  EXPECT_SAYS(read(path("out/summary.csv")), "good,paper,,done,,2");
  EXPECT_SAYS(read(path("out/report.html")), "too little texture");
}

TEST_F(Evaluate, WithoutTruthItCountsWhatIsFoundAndSaysSo) {
  render("bare", 3);
  fs::remove(path("bare/gt.csv"));
  const Outcome outcome = evaluate({"bare", "--output", "out"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_SAYS(outcome.err, "bare: has no labels");
  EXPECT_SAYS(read(path("out/summary.csv")), "bare,paper,,done,,3,0,3,,");
}

TEST_F(Evaluate, FramesThatCannotBeReadFailAndTheOthersGoOn) {
  render("broken", 2);
  render("good", 2);
  fs::remove_all(path("broken/frames"));
  const Outcome outcome = evaluate({"broken", "good", "--output", "out"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_SAYS(outcome.err, "broken, paper: failed: ");
  EXPECT_SAYS(outcome.err, "[2/2] good, paper: 2 of 2 frames found");
}

TEST_F(Evaluate, NamesWhatIsWrongOnTheCommandLine) {
  render("drift", 1);
  const auto usage = [&](const std::vector<std::string>& more, const char* words) {
    std::vector<std::string> all{"drift", "--output", "out"};
    all.insert(all.end(), more.begin(), more.end());
    const Outcome outcome = evaluate(all);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_SAYS(outcome.err, words);
  };
  usage({"--set", "match.rato=0.7"}, "track.match.rato: is no key here; did you mean ratio?");
  usage({"--set", "ratio=0.7"}, "track.ratio");
  usage({"--set", "match.ratio=0.7,2"}, "ratio");
  usage({"--set", "match.ratio"}, "KEY=VALUE");
  usage({"--set", "match.ratio=0.7,,1"}, "''");
  usage({"--method", "magic"}, "magic");
  usage({"--jobs", "0"}, "--jobs");
  EXPECT_EQ(evaluate({}).exit_code, 2);
  EXPECT_FALSE(fs::exists(path("out")));
  const Outcome help = evaluate({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* words : {"--set", "--method", "--jobs", "--fresh", "px", "ms", "default"})
    EXPECT_SAYS(help.out, words);
}

TEST_F(Evaluate, NamesWhatIsMissingOrCannotBeWritten) {
  render("drift", 1);
  const Outcome missing = evaluate({"drif", "--output", "out"});
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_SAYS(missing.err, "did you mean drift?");
  fs::create_directories(path("empty"));
  EXPECT_SAYS(evaluate({"empty"}).err, "holds no sequence");
  const Outcome twice = evaluate({"drift", "drift/sequence.txt", "--output", "out"});
  EXPECT_EQ(twice.exit_code, 1);
  EXPECT_SAYS(twice.err, "drift");
  const Outcome set_twice =
      evaluate({"drift", "--set", "ransac.seed=1", "--set", "ransac.seed=2", "--output", "out"});
  EXPECT_EQ(set_twice.exit_code, 1);
  EXPECT_SAYS(set_twice.err, "ransac.seed is given twice");
  EXPECT_FALSE(fs::exists(path("out")));
  std::ofstream(path("file")) << "in the way";
  const Outcome blocked = evaluate({"drift", "--output", "file/out"});
  EXPECT_EQ(blocked.exit_code, 1);
  EXPECT_SAYS(blocked.err, "file/out");
  const Outcome strange = evaluate({"drift", "--output", "drift"});
  EXPECT_EQ(strange.exit_code, 1);
  EXPECT_SAYS(strange.err, "something else");
  EXPECT_FALSE(fs::exists(path("drift/configuration.txt")));
}

}  // namespace
}  // namespace kestrel::test
