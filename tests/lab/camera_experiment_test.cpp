#include "kestrel/lab/camera_experiment.hpp"

#include <gtest/gtest.h>

#include "lab/lab_setup.hpp"

namespace kestrel {
namespace {

CameraExperiment experiment(Law law, int steps, int trace_every) {
  return {"S1_small", name(law), "", test::benchmark_setup("S1_small", law, steps), trace_every};
}

TEST(CameraExperiment, IsFiledUnderItsLabels) {
  CameraExperiment made = experiment(Law::Cur, 1, 0);
  EXPECT_EQ(made.id(), "S1_small/cur");
  made.modifier = "kz2";
  EXPECT_EQ(made.id(), "S1_small/cur/kz2");
}

TEST(CameraExperiment, GivesEndFiguresAndTrace) {
  const LabRun made = run(experiment(Law::Cur, 300, 7));
  EXPECT_EQ(made.end, RunEnd::Converged);
  EXPECT_EQ(made.steps, 300);
  EXPECT_EQ(made.metrics.front().first, "k_error");
  EXPECT_TRUE(made.metrics.front().second);
  EXPECT_EQ(made.law_us, 0);
  const std::vector<double> steps = made.trace.column("step");
  ASSERT_EQ(steps.size(), 44u);  // 0, 7 .. 294, and the last
  EXPECT_EQ(steps[42], 294);
  EXPECT_EQ(steps[43], 299);
  EXPECT_TRUE(run(experiment(Law::Cur, 10, 0)).trace.rows.empty());
  EXPECT_EQ(run(experiment(Law::Cur, 15, 7)).trace.rows.size(), 3u);  // 14 once
}

TEST(CameraExperiment, TimesTheLawByTheClockGiven) {
  double now_s = 0;
  const LabRun made = run(experiment(Law::Cur, 10, 0), [&] { return now_s += 3e-6; });
  EXPECT_NEAR(made.law_us, 3, 1e-9);
  EXPECT_NEAR(now_s, 2 * 3e-6, 1e-12);  // one call of sixteen is timed: reading takes time, too
  now_s = 0;
  EXPECT_NEAR(run(experiment(Law::Cur, 64, 0), [&] { return now_s += 3e-6; }).law_us, 3, 1e-9);
  EXPECT_NEAR(now_s, 4 * 2 * 3e-6, 1e-12);
}

TEST(CameraExperiment, IsTheSameEachTime) {
  CameraExperiment noisy = experiment(Law::Mean, 50, 1);
  noisy.setup.conditions.noise_px = 1;
  noisy.setup.conditions.delay_frames = 2;
  EXPECT_EQ(run(noisy).trace.rows, run(noisy).trace.rows);
}

}  // namespace
}  // namespace kestrel
