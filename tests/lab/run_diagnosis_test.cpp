#include "kestrel/lab/run_diagnosis.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "lab/feature_flight.hpp"

namespace kestrel {
namespace {

const Finding* about(const std::vector<Finding>& findings, const std::string& topic) {
  const auto found = std::find_if(findings.begin(), findings.end(),
                                  [&](const Finding& f) { return f.topic == topic; });
  return found == findings.end() ? nullptr : &*found;
}

bool is(const std::vector<Finding>& findings, const std::string& topic, Weight weight) {
  const Finding* found = about(findings, topic);
  return found != nullptr && found->weight == weight;
}

test::Truth noisy() {
  test::Truth truth;
  truth.noise_px = 0.3;
  return truth;
}

TEST(RunDiagnosis, AGoodRunIsFine) {
  const Task task = test::square_task();
  const auto findings = diagnosis(test::feature_flight(task, noisy(), 20), task);
  for (const Finding& f : findings) EXPECT_NE(f.weight, Weight::Fault) << f.topic << ": " << f.what;
  EXPECT_TRUE(is(findings, "error", Weight::Fine));
  EXPECT_TRUE(is(findings, "seen", Weight::Fine));
  EXPECT_TRUE(is(findings, "response", Weight::Fine));
  EXPECT_EQ(about(findings, "oscillation"), nullptr);
  EXPECT_EQ(about(findings, "local_minimum"), nullptr);
}

TEST(RunDiagnosis, NamesAWrongSign) {
  Task task = test::square_task();
  task.body_from_camera.rotation =
      rotation_from_vector({0, M_PI, 0}) * task.body_from_camera.rotation;
  task.servo.freedom = Freedom::Three;
  task.servo.gain_per_s = 0.2;
  const auto findings = diagnosis(test::feature_flight(task, noisy(), 6), task);
  EXPECT_TRUE(is(findings, "sign", Weight::Fault));
  EXPECT_EQ(findings.front().weight, Weight::Fault);
}

TEST(RunDiagnosis, NamesAWrongSize) {
  const Task task = test::square_task();
  test::Truth truth = noisy();
  truth.target_width_m = 0.5;
  const auto findings = diagnosis(test::feature_flight(task, truth, 20), task);
  EXPECT_TRUE(is(findings, "depth", Weight::Doubt));
}

// 0.6 s of latency and a vehicle of 0.65 s: at a gain of 2 the loop swings.
TEST(RunDiagnosis, NamesAnOscillationAndAGainThatEndsIt) {
  Task task = test::square_task();
  task.servo.gain_per_s = 2;
  task.servo.freedom = Freedom::Three;
  task.limits = CommandLimits{};
  test::Truth truth = noisy();
  truth.delay_frames = 18;
  const auto findings = diagnosis(test::feature_flight(task, truth, 40), task);
  EXPECT_TRUE(is(findings, "oscillation", Weight::Fault));
  task.servo.gain_per_s = 0.2;
  const auto calm = diagnosis(test::feature_flight(task, truth, 40), task);
  EXPECT_EQ(about(calm, "oscillation"), nullptr);
}

// A rectangle believed a square: no pose gives the view that is wanted, and the law stands still.
TEST(RunDiagnosis, NamesALocalMinimum) {
  const Task task = test::square_task();
  LogFile log = test::feature_flight(task, noisy(), 20);
  for (LogRow& row : log.rows) {
    row.servo->error = {.1, 0, -.1, 0, .1, 0, -.1, 0};
    row.servo->error_norm = 0.2;
    row.servo->twist = {};
  }
  EXPECT_TRUE(is(diagnosis(log, task), "local_minimum", Weight::Fault));
}

TEST(RunDiagnosis, NamesATargetThatWasNotSeen) {
  const Task task = test::square_task();
  LogFile log = test::feature_flight(task, noisy(), 20);
  for (std::size_t i = 0; i < log.rows.size(); ++i) {
    if (i % 5 == 0) continue;
    log.rows[i].servo.reset();
    log.rows[i].pose.reset();
    log.rows[i].miss = Miss::FewMatches;
  }
  const auto findings = diagnosis(log, task);
  EXPECT_TRUE(is(findings, "seen", Weight::Fault));
  EXPECT_NE(about(findings, "seen")->what.find(name(Miss::FewMatches)), std::string::npos);
}

TEST(RunDiagnosis, NamesALawWithoutAnswer) {
  const Task task = test::square_task();
  LogFile log = test::feature_flight(task, noisy(), 20);
  for (std::size_t i = 0; i < log.rows.size(); i += 2) log.rows[i].servo.reset();
  EXPECT_TRUE(is(diagnosis(log, task), "answer", Weight::Fault));
}

TEST(RunDiagnosis, NamesUnknownTilt) {
  const Task task = test::square_task();
  LogFile log = test::feature_flight(task, noisy(), 20);
  EXPECT_EQ(about(diagnosis(log, task), "tilt"), nullptr);
  for (LogRow& row : log.rows) row.attitude.reset();
  EXPECT_TRUE(is(diagnosis(log, task), "tilt", Weight::Doubt));
}

TEST(RunDiagnosis, AnEmptyOrShortLogIsNoCrash) {
  const Task task = test::square_task();
  EXPECT_EQ(diagnosis(LogFile{}, task).front().weight, Weight::Fault);
  LogFile log = test::feature_flight(task, {}, 20);
  log.rows.resize(3);
  EXPECT_FALSE(diagnosis(log, task).empty());
}

}  // namespace
}  // namespace kestrel
