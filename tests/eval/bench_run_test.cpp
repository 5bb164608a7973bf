#include "kestrel/eval/bench_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "eval/made_up.hpp"

namespace kestrel {
namespace {

using ::testing::HasSubstr;

TEST(RunBench, AsksForEveryFrameTheFirstIncluded) {
  const BenchSequence sequence = test::made_up_sequence("s", 4, 7);
  const auto run = run_bench(sequence, test::made_up_method("m", 0), test::made_up_hooks());
  ASSERT_TRUE(run);
  EXPECT_EQ(run->sequence, "s");
  EXPECT_EQ(run->method, "m");
  EXPECT_EQ(run->end, BenchEnd::Done);
  ASSERT_EQ(run->frames.size(), 4u);
  EXPECT_EQ(run->frames.front().frame, 7);
  EXPECT_EQ(run->frames.back().frame, 10);
}

TEST(RunBench, TimesTheTrackerOnly) {
  const auto run = *run_bench(test::made_up_sequence("s", 3), test::made_up_method("m", 0),
                              test::made_up_hooks());
  // The clock goes a millisecond further at each reading: two readings about each call.
  EXPECT_NEAR(run.learn_s, 1e-3, 1e-12);
  for (const BenchFrame& frame : run.frames) EXPECT_NEAR(frame.time_s, 1e-3, 1e-12);
}

TEST(RunBench, ARefusedTemplateIsAResult) {
  const auto run =
      run_bench(test::made_up_sequence("s", 3), test::refusing_method(), test::made_up_hooks());
  ASSERT_TRUE(run);
  EXPECT_EQ(run->end, BenchEnd::Refused);
  EXPECT_THAT(run->reason, HasSubstr("texture"));
  EXPECT_TRUE(run->frames.empty());
}

TEST(RunBench, WhatCannotBeReadOrBreaksHasFailed) {
  BenchSequence gone = test::made_up_sequence("gone", 3);
  gone.open = []() -> std::unique_ptr<FrameSource> { throw std::runtime_error("no such file"); };
  const auto unread = run_bench(gone, test::made_up_method("m", 0), test::made_up_hooks());
  EXPECT_EQ(unread->end, BenchEnd::Failed);
  EXPECT_THAT(unread->reason, HasSubstr("no such file"));

  const auto empty = run_bench(test::made_up_sequence("empty", 0), test::made_up_method("m", 0),
                               test::made_up_hooks());
  EXPECT_EQ(empty->end, BenchEnd::Failed);

  // Also std::invalid_argument, when it comes from tracking and not from learning.
  const BenchMethod breaking{"breaking", [](const cv::Mat&, const PixelBox&) -> BenchTracker {
                               return [](const Frame& frame) -> BenchAnswer {
                                 if (frame.index == 1) throw std::invalid_argument("broke");
                                 return {};
                               };
                             }};
  const auto broken = run_bench(test::made_up_sequence("s", 3), breaking, test::made_up_hooks());
  EXPECT_EQ(broken->end, BenchEnd::Failed);
  EXPECT_EQ(broken->reason, "broke");
  EXPECT_EQ(broken->frames.size(), 1u);
}

TEST(RunBench, AnInterruptedRunIsNone) {
  BenchHooks hooks = test::made_up_hooks();
  int asked = 0;
  int done = 0;
  hooks.is_interrupted = [&] { return ++asked > 2; };
  hooks.frame_done = [&] { ++done; };
  EXPECT_FALSE(run_bench(test::made_up_sequence("s", 9), test::made_up_method("m", 0), hooks));
  EXPECT_EQ(done, 2);
}

}  // namespace
}  // namespace kestrel
