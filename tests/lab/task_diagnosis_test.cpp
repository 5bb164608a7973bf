#include "kestrel/lab/task_diagnosis.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "lab/feature_flight.hpp"

namespace kestrel {
namespace {

const Finding& about(const std::vector<Finding>& findings, const std::string& topic) {
  static const Finding none{Weight::Fault, "missing", "missing", ""};
  const auto found = std::find_if(findings.begin(), findings.end(),
                                  [&](const Finding& f) { return f.topic == topic; });
  return found == findings.end() ? none : *found;
}

bool says(const Finding& finding, const std::string& words) {
  return finding.what.find(words) != std::string::npos;
}

/// The task of the helicopter benchmark, its camera ahead of and below the helicopter's middle.
Task benchmark_task() {
  Task task = test::square_task();
  task.body_from_camera.translation << 0.3, 0, 0.1;
  task.limits = CommandLimits{};
  return task;
}

/// Three freedoms, well conditioned.
Task calm_task() {
  Task task = benchmark_task();
  task.servo.freedom = Freedom::Three;
  task.servo.law = Law::Des;
  return task;
}

const std::vector<Finding>& of_calm_task() {
  static const std::vector<Finding> findings = diagnosis(calm_task(), {});
  return findings;
}

const std::vector<Finding>& of_four_freedoms() {
  static const std::vector<Finding> findings = diagnosis(benchmark_task(), {});
  return findings;
}

// The condition of a forward camera with four freedoms, 5 m before 1 m: 592 (530 with the camera in
// the helicopter's middle), in the motion to the side with a turn against it.
TEST(TaskDiagnosis, NamesTheMotionTheImageHardlyShows) {
  const Finding four = about(of_four_freedoms(), "jacobian");
  EXPECT_EQ(four.weight, Weight::Doubt);
  EXPECT_TRUE(says(four, "condition 592")) << four.what;
  EXPECT_TRUE(says(four, "right")) << four.what;
  EXPECT_EQ(about(of_calm_task(), "jacobian").weight, Weight::Fine);
}

// Limits of the lateral loop of the built-in helicopter: 5.49 per second without latency, 2.83 with
// 0.2 s (helicopter_margins); a quarter of it is fine, beyond it is a fault.
TEST(TaskDiagnosis, HoldsTheGainToTheLimitsOfRateAndLatency) {
  Task task = calm_task();
  const Finding good = about(of_calm_task(), "gain");
  EXPECT_EQ(good.weight, Weight::Fine) << good.what;
  EXPECT_TRUE(says(good, "is 60 for a vehicle")) << good.what;
  EXPECT_TRUE(says(good, "and 5.4")) << good.what;
  task.servo.gain_per_s = 1;
  EXPECT_EQ(about(diagnosis(task, {30, 0.2}), "gain").weight, Weight::Doubt);
  task.servo.gain_per_s = 3.5;
  EXPECT_EQ(about(diagnosis(task, {30, 0.2}), "gain").weight, Weight::Fault);
}

TEST(TaskDiagnosis, SaysWhatATargetToTheRightCommands) {
  // 0.02 of the normalised plane at 5 m is 0.1 m, times the gain of 0.5 per second.
  EXPECT_TRUE(says(about(of_calm_task(), "sign"),
                   "too far to the right commands forward +0.000, right +0.050, down +0.000"))
      << about(of_calm_task(), "sign").what;
}

// Four freedoms: one pixel is 0.446 m/s to the side and 4.8 deg/s for a gain of one.
TEST(TaskDiagnosis, SaysWhatAPixelOfNoiseCommands) {
  const Finding noise = about(of_four_freedoms(), "noise");
  EXPECT_EQ(noise.weight, Weight::Doubt);
  EXPECT_TRUE(says(noise, "right 0.223")) << noise.what;
  EXPECT_EQ(about(of_calm_task(), "noise").weight, Weight::Fine);
}

TEST(TaskDiagnosis, FliesFromAroundTheGoal) {
  const Finding three = about(of_calm_task(), "start");
  EXPECT_TRUE(says(three, "of 24 flights")) << three.what;
  // Nothing turns the heading with three freedoms: it stays as it was drawn.
  EXPECT_EQ(three.weight, Weight::Fault) << three.what;
  const Finding four = about(of_four_freedoms(), "start");
  EXPECT_EQ(four.weight, Weight::Fine) << four.what;
}

TEST(TaskDiagnosis, RefusesATimingThatIsNone) {
  EXPECT_THROW(diagnosis(calm_task(), {0, 0}), std::invalid_argument);
  EXPECT_THROW(diagnosis(calm_task(), {30, -1}), std::invalid_argument);
  EXPECT_THROW(diagnosis(calm_task(), {30, std::nan("")}), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel
