#include "kestrel/eval/bench_page.hpp"

#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "eval/made_up.hpp"
#include "support/markup_check.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// Two methods over an easy, a hard and an unlabelled sequence, and one that refuses.
class Page : public ::testing::Test {
 protected:
  Page() {
    plan_.sequences = {test::made_up_sequence("easy", 6), test::made_up_sequence("hard", 6),
                       test::made_up_sequence("bare", 6)};
    plan_.sequences[2].truth.clear();
    plan_.methods = {test::made_up_method("rough", 6), test::made_up_method("fine", 1),
                     test::refusing_method()};
    for (const BenchSequence& sequence : plan_.sequences) {
      for (const BenchMethod& method : plan_.methods) {
        BenchRun run = *run_bench(sequence, method, test::made_up_hooks());
        for (std::size_t i = 3; sequence.name == "hard" && i < run.frames.size(); ++i) {
          run.frames[i].answer = test::answer_at(60);
        }
        evaluation_.runs.push_back(std::move(run));
      }
    }
    evaluation_.planned = evaluation_.runs.size();
  }
  EvaluationPlan plan_;
  Evaluation evaluation_;
};

TEST_F(Page, PutsTheBestMethodAndTheHardestSequenceFirst) {
  const Report report = bench_report(plan_, evaluation_, "the configuration");
  ASSERT_EQ(report.sections.size(), 5u);
  EXPECT_EQ(report.sections[0].tables[0].rows[0][0], "fine");
  EXPECT_EQ(report.sections[0].tables[0].rows[1][0], "rough");
  EXPECT_EQ(report.sections[1].tables[0].rows[0][0], "hard");
  EXPECT_EQ(report.sections[1].tables[0].rows[0][1], "fine");
  EXPECT_EQ(report.sections[2].title, "hard");
  EXPECT_EQ(report.sections[3].title, "easy");
  EXPECT_EQ(report.sections[4].title, "bare");
}

TEST_F(Page, ShowsTheWorstFramesOfTheHardSequence) {
  const Report report = bench_report(plan_, evaluation_, "");
  ASSERT_FALSE(report.sections[2].pictures.empty());
  EXPECT_THAT(report.sections[2].pictures[0].caption, HasSubstr("fine, frame"));
  EXPECT_TRUE(report.sections[4].pictures.empty());  // without labels nothing is the worst
}

TEST_F(Page, ThePrecisionCurveIsInPercent) {
  // The better method has all frames of one sequence and half of the other: 75 at the right end.
  const std::string plot = bench_report(plan_, evaluation_, "").sections[0].figures[0];
  EXPECT_THAT(plot, HasSubstr(">60</text>"));
  EXPECT_THAT(plot, Not(HasSubstr(">100</text>")));
}

TEST_F(Page, SaysWhatIsMissing) {
  evaluation_.planned = 20;
  evaluation_.runs[0].skipped = {"frame 3: no picture"};
  const auto said = remarks(plan_, evaluation_);
  EXPECT_THAT(said, Contains(HasSubstr("9 of 20")));
  EXPECT_THAT(said, Contains(HasSubstr("easy, refusing: refused: too little texture")));
  EXPECT_THAT(said, Contains(HasSubstr("bare: has no labels")));
  EXPECT_THAT(said, Contains(HasSubstr("frame 3: no picture")));
  plan_.sequences[0].truth.erase(0);
  EXPECT_THAT(remarks(plan_, evaluation_), Contains(HasSubstr("no row for frame 0")));
}

TEST_F(Page, IsOneWellFormedPage) {
  const std::string page = report_html(bench_report(plan_, evaluation_, "a < b"));
  EXPECT_EQ(test::markup_fault(page), "");
  for (const char* words : {"Frames within an error", "Processor time", "Mean corner error",
                            "data:image/jpeg;base64", "a &lt; b"})
    EXPECT_THAT(page, HasSubstr(words));
  EXPECT_THAT(page, Not(HasSubstr("<script")));
}

TEST_F(Page, ResultsOfNothingAreFilesToo) {
  const test::TempFolder folder;
  Evaluation nothing;
  nothing.planned = 9;
  write_results(folder.path(), plan_, nothing, "");
  for (const char* name : {"summary.csv", "summary.json", "times.csv", "report.html"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / name)) << name;
  std::ostringstream page;
  page << std::ifstream(folder.path() / "report.html").rdbuf();
  EXPECT_EQ(test::markup_fault(page.str()), "");
}

}  // namespace
}  // namespace kestrel
