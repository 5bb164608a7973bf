#include "kestrel/lab/lab_plan_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kestrel/geometry/rotation.hpp"
#include "kestrel/lab/benchmark.hpp"
#include "kestrel/lab/helicopter_benchmark.hpp"

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
  EXPECT_EQ(plan_text(again(plan)), plan_text(plan));
  ASSERT_EQ(plan.modifiers.size(), 5u);
  EXPECT_EQ(plan.modifiers[0].words, "kz2");
  EXPECT_EQ(plan.modifiers[1].name, "m_depth_factor=0.5_delay_frames=0");
  EXPECT_EQ(plan.modifiers[4].name, "m_depth_factor=2_delay_frames=1");
  EXPECT_EQ(plan.modifiers[4].settings.size(), 3u);
}

TEST_F(PlanFile, ReadsEveryKeyOfTheHelicopter) {
  const LabPlan plan = load(
      "camera: {focal_px: 500}\n"
      "helicopter:\n"
      "  scenarios: [H1, {name: s, points_m: [[0, 0, 0], [1, 0, 0], [0, 1, 0]],\n"
      "    goal: {translation_m: [0, 0, 4], rpy_deg: [0, 0, 0]}, start_camera_m: [-8, 1, 0.5],\n"
      "    start_yaw_deg: 10, target_velocity_m_s: [0, 0.1, 0]}]\n"
      "  laws: [mejias, {label: a, variant: vp4, law: mean, solver: visp, gain_per_s: 0.7,\n"
      "    heading_gain_per_s: 0.9, smooth_start_per_s: 4, max_condition: 900, predicted: true,\n"
      "    limited: false}, {variant: vp3_hh, law: lm, gain_per_s: 0.25, damping: 0.1},\n"
      "    {label: b, variant: mejias, limit_right_m_s: 0.5}]\n"
      "  camera: {focal_px: 800, size_px: [1000, 800]}\n"
      "  conditions: {noise_px: 0.5, pitch_bias_deg: 2, reaction: hold, loss_from_s: 3,\n"
      "    acceleration_yaw_deg_s2: 41.7, tau_v_s: 0.6}\n"
      "  rules: {position_tolerance_m: 0.2, heading_tolerance_deg: 3, still_threshold: 1e-3,\n"
      "    still_s: 2, collision_m: 0.1, diverged_m: 40, stops_out_of_view: true}\n"
      "  modifiers: [n1, {name: m, words: kz2, period_frames: 2, on: [s], laws: [a]},\n"
      "    {name: q, sweep: {predicted: [false, true], delay_frames: [0, 6]}},\n"
      "    {sweep: {reaction: [hold, hover]}}]\n");
  const PlannedHelicopter& h = plan.helicopter;
  EXPECT_EQ(h.scenarios.at(1).goal.translation.z(), 4);
  EXPECT_EQ(h.scenarios[1].start_camera_m, Eigen::Vector3d(-8, 1, 0.5));
  ASSERT_EQ(h.laws.size(), 4u);
  const HelicopterLawOptions& law = h.laws[1].options;
  EXPECT_EQ(h.laws[1].label, "a");
  EXPECT_EQ(law.variant, HelicopterVariant::Vp4);
  EXPECT_EQ(law.law.law, Law::Mean);
  EXPECT_EQ(law.law.solver, LawSolver::Visp);
  EXPECT_EQ(law.law.gain.at_zero_per_s, 0.7);
  EXPECT_EQ(law.heading_gain_per_s, 0.9);
  EXPECT_EQ(law.law.smooth_start_per_s, 4);
  EXPECT_EQ(law.law.max_condition, 900);
  const std::vector<ConditionSetting> own{{"predicted", 1}, {"limited", 0}};
  EXPECT_EQ(h.laws[1].settings, own);
  EXPECT_EQ(h.laws[2].label, "vp3_hh_lm");
  EXPECT_EQ(h.laws[2].options.heading_gain_per_s, 0.25);  // the one gain
  EXPECT_EQ(h.laws[3].options.variant, HelicopterVariant::Mejias);
  EXPECT_EQ(h.camera.focal_px, 800);
  EXPECT_EQ(h.conditions.noise_px, 0.5);
  EXPECT_DOUBLE_EQ(h.conditions.pitch_bias_rad, M_PI / 90);
  EXPECT_EQ(h.conditions.reaction, LossReaction::Hold);
  EXPECT_EQ(h.conditions.plant.tau_v_s, 0.6);
  EXPECT_EQ(h.rules.position_tolerance_m, 0.2);
  EXPECT_DOUBLE_EQ(h.rules.heading_tolerance_rad, M_PI / 60);
  EXPECT_EQ(h.rules.still_s, 2);
  EXPECT_TRUE(h.rules.stops_out_of_view);
  ASSERT_EQ(h.modifiers.size(), 8u);
  EXPECT_EQ(h.modifiers[1].scenarios, std::vector<std::string>{"s"});
  EXPECT_EQ(h.modifiers[2].name, "q_predicted=false_delay_frames=0");
  EXPECT_EQ(h.modifiers[5].name, "q_predicted=true_delay_frames=6");
  EXPECT_EQ(h.modifiers[7].name, "reaction=hover");
  EXPECT_EQ(plan_text(again(plan)), plan_text(plan));
}

TEST_F(PlanFile, ReadsOrdersAndRefusesThoseOfNoLaw) {
  const LabPlan plan = load(std::string(kLeast) + "orders: [{scenario: S0_tutorial}]\n");
  ASSERT_EQ(plan.orders.size(), 1u);
  EXPECT_EQ(plan.orders[0].scenario, "S0_tutorial");
  EXPECT_EQ(plan_text(again(plan)), plan_text(plan));
  EXPECT_THAT(fault(std::string(kLeast) + "orders: [{scenario: S0_tutorial, laws: [des]}]\n"),
              HasSubstr("there is no law labelled des"));
  EXPECT_THAT(fault(std::string(kLeast) + "orders: [{scenario: S1_small}]\n"),
              HasSubstr("there is no scenario S1_small"));
}

TEST_F(PlanFile, TheHelicopterLooksThroughThePlansCameraUnlessItHasItsOwn) {
  EXPECT_EQ(load("camera: {focal_px: 500}\nhelicopter: {}\n").helicopter.camera.focal_px, 500);
  EXPECT_EQ(load("helicopter: {}\n").helicopter.camera.focal_px, LabCamera{}.focal_px);
}

TEST_F(PlanFile, NamesLineKeyAndRemedyOfTheHelicopter) {
  const auto heli = [&](const std::string& keys) { return fault("helicopter:\n  " + keys + "\n"); };
  EXPECT_THAT(heli("laws: [{variant: vp5, law: cur}]"),
              HasSubstr("p.yaml:2: helicopter.laws[1].variant: there is no variant vp5; did you "
                        "mean vp4?"));
  EXPECT_THAT(heli("laws: [{variant: vp4, law: curr}]"),
              HasSubstr("laws[1].law: there is no law curr; did you mean cur?"));
  EXPECT_THAT(heli("laws: [{variant: vp4}]"), HasSubstr("laws[1].law: is missing"));
  EXPECT_THAT(heli("laws: [{law: cur}]"), HasSubstr("laws[1].variant: is missing"));
  EXPECT_THAT(heli("laws: [{variant: mejias, law: cur}]"),
              HasSubstr("law: mejias is a law of its own; remove the key"));
  EXPECT_THAT(heli("laws: [{variant: vp4, law: cur, noise_px: 1}]"),
              HasSubstr("laws[1].noise_px: is no key here"));
  EXPECT_THAT(heli("laws: [{variant: vp4, law: cur, predicted: yes}]"),
              HasSubstr("predicted: 'yes' is not understood; write false or true"));
  EXPECT_THAT(heli("scenarios: [H2]"),
              HasSubstr("p.yaml:2: helicopter.scenarios: there is no scenario H2; write one "
                        "of H0, H1"));
  EXPECT_THAT(heli("conditions: {steps: 3}"), HasSubstr("conditions.steps: is no key here"));
  EXPECT_THAT(heli("conditions: {delay_frames: -1}"),
              HasSubstr("conditions.delay_frames: delay_frames: -1 is no whole number"));
  EXPECT_THAT(heli("conditions: {reaction: land}"),
              HasSubstr("'land' is not understood; write failsafe or hold or hover"));
  EXPECT_THAT(heli("modifiers: [xy3]"), HasSubstr("p.yaml:2: helicopter.modifiers: modifier"));
  EXPECT_THAT(heli("modifiers: [{sweep: {nois_px: [1]}}]"),
              HasSubstr("sweep.nois_px: nois_px: is no key of the conditions; did you mean"));
  EXPECT_THAT(heli("modifiers: [{sweep: {noise_px: [-1]}}]"), HasSubstr("sweep.noise_px"));
  EXPECT_THAT(heli("modifiers: [{name: m, on: [H7]}]"), HasSubstr("there is no scenario H7"));
  EXPECT_THAT(heli("rules: {still_s: 0}"), HasSubstr("helicopter.rules: rules: still_s must be"));
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

TEST_F(PlanFile, TheTextOfAFlightTellsEveryChange) {
  const HelicopterExperiment experiment =
      helicopter_experiment(helicopter_h0(), HelicopterVariant::Vp4, Law::Des);
  const std::string before = text_of(experiment);
  const auto changed = [&](const auto& change) {
    HelicopterExperiment other = experiment;
    change(other);
    return text_of(other) != before;
  };
  EXPECT_TRUE(changed([](auto& e) { e.setup.law.variant = HelicopterVariant::Vp3; }));
  EXPECT_TRUE(changed([](auto& e) { e.setup.law.law.law = Law::Cur; }));
  EXPECT_TRUE(changed([](auto& e) { e.setup.law.law.gain = LawGain::constant(1); }));
  EXPECT_TRUE(changed([](auto& e) { e.setup.law.heading_gain_per_s = 1; }));
  EXPECT_TRUE(changed([](auto& e) { e.setup.scenario.start_yaw_rad += 1e-9; }));
  EXPECT_TRUE(changed([](auto& e) { e.setup.camera.focal_px = 601; }));
  EXPECT_TRUE(changed([](auto& e) { e.setup.rules.still_s = 1; }));
  EXPECT_TRUE(changed([](auto& e) { e.setup.rules.heading_tolerance_rad = 1; }));
  EXPECT_TRUE(changed([](auto& e) { e.modifier = "m"; }));
  EXPECT_TRUE(changed([](auto& e) { e.trace_every = 2; }));
  for (const std::string& key : helicopter_condition_keys()) {
    const double value = key == "limited" ? 0 : 1;
    if (key == "tau_v_s" || key == "decay_s" || key == "hover_after_s" || key == "period_frames" ||
        key == "depth_factor" || key == "limit_down_m_s") {
      continue;  // 1 may be what it is
    }
    EXPECT_TRUE(changed([&](auto& e) {
      e.setup.conditions = with_setting(e.setup.conditions, {key, value});
    })) << key;
  }
  EXPECT_FALSE(changed([](auto&) {}));
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
