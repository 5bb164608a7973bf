#include "kestrel/lab/lab_plan_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kestrel/geometry/rotation.hpp"
#include "kestrel/lab/benchmark.hpp"

#include "support/random.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using ::testing::HasSubstr;

const std::filesystem::path kTasks = std::filesystem::path(KESTREL_SOURCE_DIR) / "tasks";
constexpr const char* kLeast = "laws: [cur]\nscenarios: [S0_tutorial]\n";

class PlanFile : public ::testing::Test {
 protected:
  LabPlan load(const std::string& text) { return load_plan(folder_.write("p.yaml", text)); }
  std::string fault(const std::string& text) {
    return test::message_of([&] { load(text); });
  }
  /// The plan as its own effective text reads back.
  LabPlan again(const LabPlan& plan) {
    for (const PlannedBasin& basin : plan.basins) {
      folder_.write(starts_file(basin).string(), starts_csv(basin.starts));
    }
    return load_plan(folder_.write("effective.yaml", plan_text(plan)));
  }
  test::TempFolder folder_;
};

TEST_F(PlanFile, TheShippedPlansReadAndSayThemselvesAgain) {
  for (const char* name : {"compare_6dof", "compare_basins", "compare_helicopter",
                           "compare_levelling", "compare_quick", "compare_rotation"}) {
    SCOPED_TRACE(name);
    const LabPlan plan = load_plan(kTasks / (std::string(name) + ".yaml"));
    EXPECT_EQ(plan_text(again(plan)), plan_text(plan));
  }
}

TEST_F(PlanFile, TheBenchmarksPlanIsTheBenchmark) {
  const LabPlan plan = load_plan(kTasks / "compare_6dof.yaml");
  EXPECT_EQ(plan.laws.size(), all_laws().size());
  EXPECT_EQ(plan.scenarios.size(), benchmark_scenarios().size());
  ASSERT_EQ(plan.modifiers.size(), benchmark_modifiers().size());
  for (std::size_t i = 0; i < plan.modifiers.size(); ++i) {
    EXPECT_EQ(plan.modifiers[i].words, benchmark_modifiers()[i]);
    EXPECT_EQ(plan.modifiers[i].name, plan.modifiers[i].words);
  }
}

TEST_F(PlanFile, ReadsEveryKey) {
  const LabPlan plan = load(
      "title: t\ntrace_every: 7\nsettled_error: 1e-4\n"
      "laws: [{label: a, law: lm, solver: visp, gain_at_zero_per_s: 4, gain_at_infinity_per_s: 1,\n"
      "  gain_slope_per_s: 30, smooth_start_per_s: 4, rank_tolerance: 1e-5, max_condition: 900,\n"
      "  damping: 0.1, learning_gate: 0.2, forgetting: 0.5, initial_covariance: 10}]\n"
      "scenarios: [{name: s, points_m: [[0, 0, 0], [1, 0, 0], [0, 1, 0]],\n"
      "  goal: {translation_m: [0, 0, 2], rpy_deg: [0, 0, 90]},\n"
      "  start: {translation_m: [0, 0, 3], rpy_deg: [0, 0, 0]}}]\n"
      "camera: {focal_px: 500, principal_px: [300, 200], size_px: [600, 400]}\n"
      "conditions: {desired: model, rate_hz: 60, limit_linear_m_s: 2, limit_angular_deg_s: 41.7}\n"
      "rules: {error_threshold: 2e-3, pose_tolerance_deg: 2, settled_steps: 5,\n"
      "  stops_out_of_view: true}\n");
  EXPECT_EQ(plan.title, "t");
  EXPECT_EQ(plan.trace_every, 7);
  EXPECT_EQ(plan.settled_error, 1e-4);
  const LawOptions& law = plan.laws.at(0).options;
  EXPECT_EQ(plan.laws[0].label, "a");
  EXPECT_EQ(law.law, Law::Lm);
  EXPECT_EQ(law.solver, LawSolver::Visp);
  EXPECT_EQ(law.gain.at_zero_per_s, 4);
  EXPECT_EQ(law.gain.at_infinity_per_s, 1);
  EXPECT_EQ(law.gain.slope_at_zero_per_s, 30);
  EXPECT_EQ(law.smooth_start_per_s, 4);
  EXPECT_EQ(law.rank_tolerance, 1e-5);
  EXPECT_EQ(law.max_condition, 900);
  EXPECT_EQ(law.damping, 0.1);
  EXPECT_EQ(law.learning_gate, 0.2);
  EXPECT_EQ(law.forgetting, 0.5);
  EXPECT_EQ(law.initial_covariance, 10);
  EXPECT_EQ(plan.scenarios.at(0).points_m.size(), 3u);
  EXPECT_EQ(plan.scenarios[0].goal.translation.z(), 2);
  EXPECT_EQ(plan.camera.focal_px, 500);
  EXPECT_EQ(plan.camera.height_px, 400);
  EXPECT_EQ(plan.conditions.desired, Conditions::Desired::Model);
  EXPECT_EQ(plan.conditions.rate_hz, 60);
  EXPECT_EQ(plan.conditions.limits->linear_m_s, 2);
  EXPECT_EQ(plan.rules.error_threshold, 2e-3);
  EXPECT_DOUBLE_EQ(plan.rules.pose_tolerance_rad, M_PI / 90);
  EXPECT_EQ(plan.rules.settled_steps, 5);
  EXPECT_TRUE(plan.rules.stops_out_of_view);
  EXPECT_EQ(plan_text(again(plan)), plan_text(plan));
}

TEST_F(PlanFile, AStartIsThatOfTheTargetOrThatOfTheCamera) {
  const std::string head =
      "laws: [cur]\nscenarios: [{name: s, square_m: 1, "
      "goal: {translation_m: [0, 0, 2], rpy_deg: [0, 0, 0]}, ";
  const LabPlan plan =
      load(head + "start_in_goal: {translation_m: [0, 0, -1], theta_u_deg: [0, 0, 90]}}]\n");
  // One metre behind the goal's camera: the target is 3 m ahead, turned the other way.
  const TargetPose& start = plan.scenarios.at(0).start;
  EXPECT_NEAR(start.translation.z(), 3, 1e-12);
  EXPECT_NEAR(rotation_vector(start.rotation).z(), -M_PI / 2, 1e-12);
}

TEST_F(PlanFile, SweepsMakeAModifierForEachCombination) {
  const LabPlan plan =
      load(std::string(kLeast) +
           "modifiers: [kz2, {name: m, noise_px: 1, sweep: {depth_factor: [0.5, 2], "
           "delay_frames: [0, 1]}, on: [S0_tutorial]}]\n");
  ASSERT_EQ(plan.modifiers.size(), 5u);
  EXPECT_EQ(plan.modifiers[0].words, "kz2");
  EXPECT_EQ(plan.modifiers[1].name, "m_depth_factor=0.5_delay_frames=0");
  EXPECT_EQ(plan.modifiers[4].name, "m_depth_factor=2_delay_frames=1");
  EXPECT_EQ(plan.modifiers[4].settings.size(), 3u);
}

TEST_F(PlanFile, NamesLineKeyAndRemedy) {
  EXPECT_THAT(fault("laws: [curr]\nscenarios: [S0_tutorial]\n"),
              HasSubstr("p.yaml:1: laws: there is no law curr; did you mean cur?"));
  EXPECT_THAT(fault("laws: [cur]\nscenarios: [S0_tutorail]\n"),
              HasSubstr("p.yaml:2: scenarios: there is no scenario S0_tutorail; did you mean "
                        "S0_tutorial?"));
  EXPECT_THAT(fault(std::string(kLeast) + "conditions: {depth_facter: 2}\n"),
              HasSubstr("p.yaml:3: conditions.depth_facter: is no key here; did you mean "
                        "depth_factor?"));
  EXPECT_THAT(fault(std::string(kLeast) + "conditions: {depth_factor: -2}\n"),
              HasSubstr("p.yaml:3: conditions.depth_factor: conditions: depth_factor must be"));
  EXPECT_THAT(fault(std::string(kLeast) + "modifiers: [xy3]\n"), HasSubstr("p.yaml:3: modifiers"));
  EXPECT_THAT(fault(std::string(kLeast) + "modifiers: [{noise_px: 1}]\n"),
              HasSubstr("modifiers[1].name: is missing"));
  EXPECT_THAT(fault("laws: [{law: cur, gain: 2}]\nscenarios: [S0_tutorial]\n"),
              HasSubstr("p.yaml:1: laws[1].gain: is no key here"));
  EXPECT_THAT(fault(std::string(kLeast) + "basins: [{name: b, scenario: S0_tutorial}]\n"),
              HasSubstr("poses: must be 1 or more"));
  EXPECT_THAT(fault(std::string(kLeast) + "helicopter: {laws: [vp5]}\n"), HasSubstr("no law vp5"));
  EXPECT_THAT(fault("title: x\n"), HasSubstr("nothing to run"));
}

TEST_F(PlanFile, StartsReadBackTheSameBits) {
  test::Random random("starts");
  std::vector<StartPose> starts;
  for (int i = 0; i < 50; ++i) starts.push_back({random.vector3(1), random.rotation_vector(3)});
  const auto back = load_starts(folder_.write("s.csv", starts_csv(starts)));
  ASSERT_EQ(back.size(), starts.size());
  for (std::size_t i = 0; i < back.size(); ++i) {
    EXPECT_EQ(back[i].translation_m, starts[i].translation_m);
    EXPECT_EQ(back[i].rotation_vector_rad, starts[i].rotation_vector_rad);
  }
  folder_.write("s.csv", starts_csv({}) + "1,2,3,4,5\n");
  EXPECT_THAT(test::message_of([&] { load_starts(folder_ / "s.csv"); }),
              HasSubstr("s.csv:2: has not six numbers"));
}

TEST_F(PlanFile, TheTextOfARunTellsEveryChange) {
  CameraExperiment experiment{"s", "cur", "", {}, 1};
  experiment.setup.scenario = benchmark_scenarios()[0];
  const std::string before = text_of(experiment);
  const auto changed = [&](const auto& change) {
    CameraExperiment other = experiment;
    change(other);
    return text_of(other) != before;
  };
  EXPECT_TRUE(changed([](auto& e) { e.setup.law.law = Law::Des; }));
  EXPECT_TRUE(changed([](auto& e) { e.setup.law.damping = 1; }));
  EXPECT_TRUE(changed([](auto& e) { e.setup.law.max_condition = 10; }));
  EXPECT_TRUE(changed([](auto& e) { e.setup.scenario.start.translation.x() += 1e-15; }));
  EXPECT_TRUE(changed([](auto& e) { e.setup.conditions.limits.emplace(); }));
  EXPECT_TRUE(changed([](auto& e) { e.setup.conditions.gain_per_s = 1; }));
  EXPECT_TRUE(changed([](auto& e) { e.setup.rules.settled_steps = 1; }));
  EXPECT_TRUE(changed([](auto& e) { e.setup.camera.width_px = 641; }));
  EXPECT_TRUE(changed([](auto& e) { e.trace_every = 2; }));
  EXPECT_FALSE(changed([](auto&) {}));
}

}  // namespace
}  // namespace kestrel
