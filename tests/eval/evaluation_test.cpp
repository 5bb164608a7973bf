#include "kestrel/eval/evaluation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kestrel/eval/bench_page.hpp"
#include "kestrel/eval/bench_table.hpp"

#include "eval/made_up.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using ::testing::HasSubstr;

class Evaluating : public ::testing::Test {
 protected:
  Evaluating() {
    plan_.sequences = {test::made_up_sequence("a", 5), test::made_up_sequence("b", 3)};
    plan_.methods = {test::made_up_method("fine", 1, &fine_),
                     test::made_up_method("rough", 6, &rough_)};
    options_.folder = folder_.path() / "out";
    hooks_.thread_clock_s = [] { return 0.0; };
    hooks_.is_interrupted = [] { return false; };
    hooks_.tell = [](const EvaluationProgress&) {};
  }
  Evaluation run() { return evaluate(plan_, options_, hooks_); }
  std::string message() {
    return test::message_of([&] { run(); });
  }
  int learned() const { return fine_ + rough_; }

  test::TempFolder folder_;
  std::atomic<int> fine_{0};
  std::atomic<int> rough_{0};
  EvaluationPlan plan_;
  EvaluationOptions options_;
  EvaluationHooks hooks_;
};

TEST_F(Evaluating, RunsEveryMethodOverEverySequenceInOrder) {
  const Evaluation evaluation = run();
  ASSERT_TRUE(evaluation.is_complete());
  ASSERT_EQ(evaluation.runs.size(), 4u);
  EXPECT_EQ(evaluation.runs[0].sequence + evaluation.runs[0].method, "afine");
  EXPECT_EQ(evaluation.runs[1].sequence + evaluation.runs[1].method, "arough");
  EXPECT_EQ(evaluation.runs[2].sequence + evaluation.runs[2].method, "bfine");
  EXPECT_EQ(evaluation.runs[2].frames.size(), 3u);
}

TEST_F(Evaluating, TheNumberOfThreadsChangesNothing) {
  const auto text = [&](int jobs) {
    options_.folder = folder_.path() / std::to_string(jobs);
    options_.jobs = jobs;
    return csv(run_table(scores_of(plan_, run())));
  };
  const std::string one = text(1);
  EXPECT_EQ(one, text(2));
  EXPECT_EQ(one, text(9));
}

TEST_F(Evaluating, WhatIsFinishedIsNotRunAgain) {
  const std::string first = csv(run_table(scores_of(plan_, run())));
  EXPECT_EQ(learned(), 4);
  const Evaluation again = run();
  EXPECT_EQ(learned(), 4);
  EXPECT_EQ(again.reused, 4u);
  EXPECT_EQ(csv(run_table(scores_of(plan_, again))), first);
  options_.earlier = Earlier::Redone;
  EXPECT_EQ(run().reused, 0u);
  EXPECT_EQ(learned(), 8);
}

TEST_F(Evaluating, WhatChangedIsRunAgain) {
  run();
  plan_.inputs["rough"] = "other settings";
  run();
  EXPECT_EQ(fine_, 2);
  EXPECT_EQ(rough_, 4);
  plan_.sequences[0].template_px.width -= 1;
  run();
  EXPECT_EQ(fine_, 3);
  plan_.sequences[1].truth[2][0].u += 0.5;
  run();
  EXPECT_EQ(fine_, 4);
  plan_.inputs["b"] = "other files";
  run();
  EXPECT_EQ(fine_, 5);
  plan_.inputs[""] = "another program";
  run();
  EXPECT_EQ(fine_, 7);
}

TEST_F(Evaluating, AnInterruptionKeepsWhatIsFinished) {
  bool is_stopped = false;
  hooks_.is_interrupted = [&] { return is_stopped; };
  hooks_.tell = [&](const EvaluationProgress& now) { is_stopped = now.finished == 2; };
  const Evaluation half = run();
  EXPECT_EQ(half.runs.size(), 2u);
  EXPECT_FALSE(half.is_complete());
  EXPECT_THAT(remarks(plan_, half), testing::Contains(HasSubstr("interrupted: 2 of 4")));
  is_stopped = false;
  hooks_.tell = [](const EvaluationProgress&) {};
  const Evaluation whole = run();
  EXPECT_EQ(whole.reused, 2u);
  EXPECT_TRUE(whole.is_complete());
  EXPECT_EQ(learned(), 4);
}

TEST_F(Evaluating, ARefusalAndAFailureDoNotStopTheOthers) {
  plan_.methods.push_back(test::refusing_method());
  int opened = 0;
  plan_.sequences[0].open = [&]() -> std::unique_ptr<FrameSource> {
    ++opened;
    throw std::runtime_error("unplugged");
  };
  const Evaluation evaluation = run();
  ASSERT_EQ(evaluation.runs.size(), 6u);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(evaluation.runs[std::size_t(i)].end, BenchEnd::Failed);
  EXPECT_EQ(evaluation.runs[3].end, BenchEnd::Done);
  EXPECT_EQ(evaluation.runs[5].end, BenchEnd::Refused);
  EXPECT_EQ(run().reused, 3u);  // a failure is tried again, a refusal is a result
  EXPECT_EQ(opened, 6);
}

TEST_F(Evaluating, TellsHowFarItIs) {
  std::vector<std::string> finished;
  std::int64_t frames = 0;
  hooks_.tell = [&](const EvaluationProgress& now) {
    EXPECT_EQ(now.runs, 4u);
    if (now.run != nullptr) finished.push_back(now.run->sequence + now.run->method);
    frames = now.frames;
  };
  run();
  EXPECT_THAT(finished, testing::ElementsAre("afine", "arough", "bfine", "brough"));
  EXPECT_EQ(frames, 16);
}

TEST_F(Evaluating, RefusesAPlanThatIsNone) {
  plan_.sequences.push_back(plan_.sequences[0]);
  EXPECT_THAT(message(), HasSubstr("called a"));
  plan_.sequences.clear();
  EXPECT_THAT(message(), HasSubstr("no sequence"));
  plan_.sequences = {test::made_up_sequence("a", 1)};
  plan_.methods.clear();
  EXPECT_THAT(message(), HasSubstr("no method"));
  plan_.methods = {test::made_up_method("m", 0)};
  options_.jobs = 0;
  EXPECT_THAT(message(), HasSubstr("jobs"));
}

TEST_F(Evaluating, AFolderThatCannotBeWrittenEndsItAll) {
  folder_.write("out", "in the way");
  options_.jobs = 2;
  EXPECT_THAT(message(), HasSubstr("out"));
}

}  // namespace
}  // namespace kestrel
