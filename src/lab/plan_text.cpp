#include <algorithm>
#include <cmath>

#include "kestrel/geometry/rotation.hpp"
#include "kestrel/io/csv.hpp"
#include "kestrel/io/text_file.hpp"
#include "kestrel/lab/benchmark.hpp"
#include "kestrel/lab/lab_plan_file.hpp"

#include "plan_keys.hpp"

namespace kestrel {
namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text)
    out += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return out + '"';
}

template <class Numbers>
std::string list(const Numbers& numbers) {
  std::string text;
  for (const double value : numbers) text += (text.empty() ? "" : ", ") + number(value);
  return "[" + text + "]";
}

std::string list(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + quoted(word);
  return "[" + text + "]";
}

template <class Struct>
std::string numbers_text(const std::vector<NumberKey<Struct>>& keys, const Struct& from) {
  std::string text;
  for (const NumberKey<Struct>& key : keys) {
    const double value = from.*key.number;
    if (std::isfinite(value))
      text += std::string(", ") + key.key + ": " + number(in_unit(value, key.unit));
  }
  return text;
}

std::string text_of(const PlannedLaw& law) {
  return "{label: " + quoted(law.label) + ", law: " + quoted(name(law.options.law)) +
         ", solver: " + name(law.options.solver) + numbers_text(gain_keys(), law.options.gain) +
         numbers_text(law_keys(), law.options) + "}";
}

std::string pose_text(const Eigen::Matrix3d& R, const Eigen::Vector3d& t) {
  const Eigen::Matrix3d rows = R.transpose();  // stored by columns
  return "{translation_m: " + list(t) +
         ", rotation: " + list(std::vector<double>(rows.data(), rows.data() + 9)) + "}";
}

std::string full_text(const Scenario& scenario) {
  std::string points;
  for (const Eigen::Vector3d& p : scenario.points_m) {
    points += (points.empty() ? "" : ", ") + list(p);
  }
  return "{name: " + quoted(scenario.name) + ", points_m: [" + points +
         "], goal: " + pose_text(scenario.goal.rotation, scenario.goal.translation) +
         ", start: " + pose_text(scenario.start.rotation, scenario.start.translation) + "}";
}

/// The name alone where that says it all.
std::string short_text(const Scenario& scenario) {
  const std::vector<Scenario>& known = benchmark_scenarios();
  const bool is_known = std::any_of(known.begin(), known.end(), [&](const Scenario& candidate) {
    return full_text(candidate) == full_text(scenario);
  });
  return is_known ? quoted(scenario.name) : full_text(scenario);
}

std::string text_of(const LabCamera& camera) {
  return "{focal_px: " + number(camera.focal_px) + ", principal_px: [" +
         number(camera.principal_u_px) + ", " + number(camera.principal_v_px) + "], size_px: [" +
         std::to_string(camera.width_px) + ", " + std::to_string(camera.height_px) + "]}";
}

std::string text_of(const Conditions& conditions) {
  std::string text = "{desired: ";
  text += conditions.desired == Conditions::Desired::Model ? "model" : "taught";
  for (const std::string& key : condition_keys()) {
    if (const auto value = setting_of(conditions, key)) text += ", " + key + ": " + number(*value);
  }
  return text + "}";
}

std::string text_of(const RunRules& rules) {
  return "{stops_out_of_view: " + std::string(rules.stops_out_of_view ? "true" : "false") +
         ", settled_steps: " + std::to_string(rules.settled_steps) +
         numbers_text(rule_keys(), rules) + "}";
}

std::string text_of(const PlannedModifier& modifier) {
  std::string text = "{name: " + quoted(modifier.name);
  if (!modifier.words.empty()) text += ", words: " + quoted(modifier.words);
  for (const auto& [key, value] : modifier.settings) text += ", " + key + ": " + number(value);
  if (!modifier.scenarios.empty()) text += ", on: " + list(modifier.scenarios);
  if (!modifier.laws.empty()) text += ", laws: " + list(modifier.laws);
  return text + "}";
}

std::string laws_text(const std::vector<std::string>& laws) {
  return laws.empty() ? "" : ", laws: " + list(laws);
}

std::string text_of(const SweptKey& axis) {
  return "{key: " + axis.key + ", values: " + list(axis.values) + "}";
}

std::string text_of(const PlannedMap& map) {
  return "{name: " + quoted(map.name) + ", scenario: " + quoted(map.scenario) +
         laws_text(map.laws) + ", x: " + text_of(map.x) + ", y: " + text_of(map.y) + "}";
}

std::string text_of(const PlannedBasin& basin) {
  return "{name: " + quoted(basin.name) + ", scenario: " + quoted(basin.scenario) +
         laws_text(basin.laws) + ", file: " + quoted(starts_file(basin).string()) + "}";
}

std::string text_of(const PlannedMargin& margin) {
  return "{scenario: " + quoted(margin.scenario) + laws_text(margin.laws) +
         ", gain: " + (margin.gain ? "true" : "false") +
         ", delay: " + (margin.delay ? "true" : "false") + "}";
}

std::string full_text(const HelicopterScenario& s) {
  std::string points;
  for (const Eigen::Vector3d& p : s.points_m) points += (points.empty() ? "" : ", ") + list(p);
  return "{name: " + quoted(s.name) + ", points_m: [" + points +
         "], goal: " + pose_text(s.goal.rotation, s.goal.translation) +
         ", start_camera_m: " + list(s.start_camera_m) +
         ", start_yaw_deg: " + number(in_unit(s.start_yaw_rad, kPlanDegree)) +
         ", target_velocity_m_s: " + list(s.target_velocity_m_s) + ", body_from_camera: " +
         pose_text(s.body_from_camera.rotation, s.body_from_camera.translation) +
         ", world_from_target: " +
         pose_text(s.world_from_target.rotation, s.world_from_target.translation) + "}";
}

std::string flights_text(const PlannedHelicopter& planned) {
  const std::vector<HelicopterScenario>& known = helicopter_scenarios();
  std::string text = "helicopter:\n  scenarios:\n";
  for (const HelicopterScenario& scenario : planned.scenarios) {
    const bool is_known = std::any_of(known.begin(), known.end(), [&](const auto& candidate) {
      return full_text(candidate) == full_text(scenario);
    });
    text += "    - " + (is_known ? quoted(scenario.name) : full_text(scenario)) + '\n';
  }
  text += "  laws: " + list(planned.laws) + '\n';
  return text + "  modifiers: " + list(planned.modifiers) + '\n';
}

template <class Part, class Text>
std::string block(const char* key, const std::vector<Part>& parts, const Text& text) {
  if (parts.empty()) return "";
  std::string lines = std::string(key) + ":\n";
  for (const Part& part : parts) lines += "  - " + text(part) + '\n';
  return lines;
}

}  // namespace

std::string plan_text(const LabPlan& plan) {
  const auto any = [](const auto& part) { return text_of(part); };
  std::string text = "title: " + quoted(plan.title) + '\n';
  text += "trace_every: " + std::to_string(plan.trace_every) + '\n';
  text += "settled_error: " + number(plan.settled_error) + '\n';
  text += "camera: " + text_of(plan.camera) + '\n';
  text += "conditions: " + text_of(plan.conditions) + '\n';
  text += "rules: " + text_of(plan.rules) + '\n';
  text += block("laws", plan.laws, any);
  text += block("scenarios", plan.scenarios, short_text);
  text += block("modifiers", plan.modifiers, any);
  text += block("maps", plan.maps, any);
  text += block("basins", plan.basins, any);
  text += block("margins", plan.margins, any);
  if (!plan.helicopter.laws.empty()) text += flights_text(plan.helicopter);
  return text;
}

std::string text_of(const HelicopterExperiment& experiment) {
  return experiment.law + '\n' + full_text(experiment.setup.scenario) + '\n' +
         text_of(experiment.setup.camera) + '\n' + experiment.modifier + ' ' +
         std::to_string(experiment.trace_every);
}

std::string text_of(const CameraExperiment& experiment) {
  const CameraSetup& setup = experiment.setup;
  return text_of(PlannedLaw{experiment.law, setup.law}) + '\n' + full_text(setup.scenario) + '\n' +
         text_of(setup.camera) + '\n' + text_of(setup.conditions) + '\n' + text_of(setup.rules) +
         "\n" + experiment.modifier + " " + std::to_string(experiment.trace_every);
}

}  // namespace kestrel
