#include "kestrel/eval/bench_score.hpp"

#include <gtest/gtest.h>

#include "eval/made_up.hpp"

namespace kestrel {
namespace {

TEST(EstimateOf, MapsTheFirstImageNotTheTemplate) {
  const BenchRun run = test::made_up_run(test::made_up_sequence("s", 3), 0);
  const TrackEstimate estimate = estimate_of(run);
  ASSERT_EQ(estimate.size(), 3u);
  const Pixel moved = *estimate.at(2) * Pixel{15, 33};
  EXPECT_DOUBLE_EQ(moved.u, 17);
  EXPECT_DOUBLE_EQ(moved.v, 33);
}

TEST(JudgedBy, KeepsTheRowsOfTheFramesThatWereGiven) {
  const BenchSequence sequence = test::made_up_sequence("s", 5, 10);
  BenchRun run = test::made_up_run(sequence, 0);
  TrackTruth truth = sequence.truth;
  truth[3] = truth[20] = test::corners_at(0);  // outside the part that was run
  run.frames.erase(run.frames.begin() + 2);    // could not be decoded
  const TrackTruth rows = judged_by(truth, run);
  EXPECT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows.count(12), 0u);
  EXPECT_EQ(rows.begin()->first, 10);
}

TEST(JudgedBy, NeedsALabelWhereTheTemplateWasLearned) {
  const BenchSequence sequence = test::made_up_sequence("s", 5);
  TrackTruth truth = sequence.truth;
  truth.erase(0);
  EXPECT_TRUE(judged_by(truth, test::made_up_run(sequence, 0)).empty());
  EXPECT_FALSE(bench_score(test::made_up_run(sequence, 0), truth).is_judged);
}

TEST(BenchScore, ErrorIsTheOffsetOfTheTracker) {
  const BenchSequence sequence = test::made_up_sequence("s", 8);
  const BenchScore score = bench_score(test::made_up_run(sequence, 4), sequence.truth);
  EXPECT_TRUE(score.is_judged);
  EXPECT_NEAR(score.metrics.median_px.value(), 4, 1e-12);
  EXPECT_EQ(score.metrics.within_3px, 0);
  EXPECT_EQ(score.metrics.within_5px, 1);
  EXPECT_EQ(score.correct(), 1);
  EXPECT_EQ(score.window_width_px, 30);
  EXPECT_EQ(score.window_height_px, 40);
  EXPECT_EQ(score.keypoints, 100);
  EXPECT_EQ(score.matches, 20);
  EXPECT_EQ(score.inliers, 10);
  EXPECT_NEAR(score.time_s->max, 1e-3, 1e-12);
}

TEST(BenchScore, WithoutLabelsItCountsWhatWasFound) {
  const BenchSequence sequence = test::made_up_sequence("s", 4);
  BenchRun run = test::made_up_run(sequence, 50);
  run.frames[1].answer.image_from_template.reset();
  const BenchScore score = bench_score(run, {});
  EXPECT_FALSE(score.is_judged);
  EXPECT_EQ(score.found, 3);
  EXPECT_DOUBLE_EQ(score.correct(), 0.75);
}

TEST(BenchScore, ARefusedTemplateFoundNothing) {
  const BenchSequence sequence = test::made_up_sequence("s", 4);
  const auto run = *run_bench(sequence, test::refusing_method(), test::made_up_hooks());
  const BenchScore score = bench_score(run, sequence.truth);
  EXPECT_TRUE(score.is_judged);
  EXPECT_EQ(score.metrics.labelled, 4);
  EXPECT_EQ(score.metrics.coverage(), 0);
  EXPECT_FALSE(score.time_s);
}

TEST(MethodScores, CountEachSequenceAlike) {
  const BenchSequence small = test::made_up_sequence("small", 2);
  const BenchSequence large = test::made_up_sequence("large", 100);
  const std::vector<BenchRun> runs{test::made_up_run(small, 0), test::made_up_run(large, 30)};
  const auto methods =
      method_scores({bench_score(runs[0], small.truth), bench_score(runs[1], large.truth)}, runs);
  ASSERT_EQ(methods.size(), 1u);
  EXPECT_EQ(methods[0].sequences, 2);
  EXPECT_DOUBLE_EQ(methods[0].within_1px, 0.5);
  EXPECT_DOUBLE_EQ(methods[0].coverage, 1);
  EXPECT_DOUBLE_EQ(methods[0].median_px.value(), 15);
  EXPECT_EQ(methods[0].labelled, 102);
  EXPECT_EQ(methods[0].wrong, 100);
  EXPECT_EQ(methods[0].far_wrong, 100);
  EXPECT_EQ(methods[0].time_s->count, 102);
}

TEST(MethodScores, TheBestComesFirstAndAFailureIsLeftOut) {
  const BenchSequence sequence = test::made_up_sequence("s", 3);
  std::vector<BenchRun> runs{test::made_up_run(sequence, 6), test::made_up_run(sequence, 2),
                             test::made_up_run(sequence, 2)};
  runs[0].method = "rough";
  runs[1].method = runs[2].method = "fine";
  runs[2].end = BenchEnd::Failed;
  std::vector<BenchScore> scores;
  for (const BenchRun& run : runs) scores.push_back(bench_score(run, sequence.truth));
  const auto methods = method_scores(scores, runs);
  ASSERT_EQ(methods.size(), 2u);
  EXPECT_EQ(methods[0].method, "fine");
  EXPECT_EQ(methods[0].sequences, 1);
  EXPECT_EQ(methods[0].failed, 1);
  EXPECT_NEAR(methods[0].area_10px, 0.8, 1e-12);
  EXPECT_NEAR(methods[1].area_10px, 0.4, 1e-12);
}

}  // namespace
}  // namespace kestrel
