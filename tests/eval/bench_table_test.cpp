#include "kestrel/eval/bench_table.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "eval/made_up.hpp"

namespace kestrel {
namespace {

/// The value of a column, in the table's first row.
SummaryValue at(const Table& table, const std::string& column) {
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (table.columns[i].name == column) return table.rows.front()[i];
  }
  ADD_FAILURE() << "no column " << column;
  return 0.0;
}

double number_at(const Table& table, const std::string& column) {
  return std::get<double>(at(table, column));
}

BenchScore score_of(double off_px, int lost) {
  const BenchSequence sequence = test::made_up_sequence("s", 8);
  BenchRun run = test::made_up_run(sequence, off_px);
  run.method = "paper ransac.seed=1 match.ratio=0.7";
  for (int i = 0; i < lost; ++i) run.frames[std::size_t(1 + i)].answer.image_from_template.reset();
  return bench_score(run, sequence.truth);
}

TEST(MethodName, IsCutAtItsFirstSpace) {
  EXPECT_EQ(method_name("paper").method, "paper");
  EXPECT_EQ(method_name("paper").settings, "");
  EXPECT_EQ(method_name("paper a=1 b=2").method, "paper");
  EXPECT_EQ(method_name("paper a=1 b=2").settings, "a=1 b=2");
}

TEST(RunTable, SaysWhatTheScoreSays) {
  const Table table = run_table({score_of(1.5, 2)});
  EXPECT_EQ(std::get<std::int64_t>(at(table, "labelled")), 8);
  EXPECT_DOUBLE_EQ(number_at(table, "coverage_percent"), 75);
  EXPECT_DOUBLE_EQ(number_at(table, "within_1px_percent"), 0);
  EXPECT_DOUBLE_EQ(number_at(table, "within_2px_percent"), 75);
  EXPECT_NEAR(number_at(table, "area_10px_percent"), 75 * 0.85, 1e-9);
  EXPECT_NEAR(number_at(table, "median_px"), 1.5, 1e-12);
  EXPECT_EQ(std::get<std::int64_t>(at(table, "longest_gap_frames")), 2);
  EXPECT_EQ(number_at(table, "recovery_median_frames"), 2);
  EXPECT_EQ(std::get<std::string>(at(table, "ransac.seed")), "1");
  EXPECT_EQ(std::get<std::string>(at(table, "match.ratio")), "0.7");
}

TEST(RunTable, WrongIsAShareOfTheLabelledFrames) {
  const Table wrong = run_table({score_of(15, 0)});
  EXPECT_EQ(number_at(wrong, "wrong_10px_percent"), 100);
  EXPECT_EQ(number_at(wrong, "wrong_20px_percent"), 0);
  EXPECT_EQ(number_at(run_table({score_of(25, 4)}), "wrong_20px_percent"), 50);
}

TEST(RunTable, HoldsNoTime) {
  const Table table = run_table({score_of(1, 0)});
  for (const Column& column : table.columns) {
    EXPECT_EQ(column.name.find("_ms"), std::string::npos) << column.name;
  }
  BenchScore slow = score_of(1, 0);
  slow.learn_s = 5;
  slow.time_s->mean = slow.time_s->max = 7;
  EXPECT_EQ(csv(run_table({slow})), csv(table));
  EXPECT_EQ(summary_json({slow}, {}), summary_json({score_of(1, 0)}, {}));
}

TEST(RunTable, WithoutLabelsScoresAreMissing) {
  BenchScore score = bench_score(test::made_up_run(test::made_up_sequence("s", 4), 1), {});
  const Table table = run_table({score});
  EXPECT_TRUE(std::isnan(number_at(table, "within_5px_percent")));
  EXPECT_TRUE(std::isnan(number_at(table, "labelled")));
  EXPECT_EQ(std::get<std::int64_t>(at(table, "found")), 4);
}

TEST(TimeTable, IsInMilliseconds) {
  const Table table = time_table({score_of(1, 0)});
  // The made-up clock goes a millisecond further at each reading.
  for (const char* column : {"learn_ms", "mean_ms", "median_ms", "p95_ms", "max_ms"})
    EXPECT_NEAR(number_at(table, column), 1, 1e-9);
}

TEST(PaperTable, IsTableOneOfThePaper) {
  const Table table = paper_table({score_of(1.5, 2)});
  EXPECT_EQ(std::get<std::string>(at(table, "window_px")), "30x40");
  EXPECT_EQ(number_at(table, "SIFT"), 100);
  EXPECT_EQ(number_at(table, "matched"), 20);
  EXPECT_EQ(number_at(table, "correct_percent"), 75);
  EXPECT_NEAR(number_at(table, "mean_ms"), 1, 1e-9);
}

TEST(MethodTable, HasTheMethodsShares) {
  MethodScore method;
  method.method = "paper";
  method.judged = 1;
  method.within_5px = 0.25;
  method.wrong = 3;
  const Table table = method_table({method});
  EXPECT_EQ(number_at(table, "within_5px_percent"), 25);
  EXPECT_EQ(std::get<std::int64_t>(at(table, "wrong_10px")), 3);
  EXPECT_EQ(method_time_table({method}).columns.size(), table.columns.size() + 4);
}

}  // namespace
}  // namespace kestrel
