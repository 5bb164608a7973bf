#include <algorithm>

#include "kestrel/lab/benchmark.hpp"
#include "kestrel/lab/lab_plan_file.hpp"

#include "plan_text_parts.hpp"

namespace kestrel {
namespace {

std::string text_of(const PlannedLaw& law) {
  return "{label: " + quoted(law.label) + ", law: " + quoted(name(law.options.law)) +
         options_text(law.options) + "}";
}

std::string full_text(const Scenario& scenario) {
  return "{name: " + quoted(scenario.name) + ", points_m: " + points_text(scenario.points_m) +
         ", goal: " + pose_text(scenario.goal.rotation, scenario.goal.translation) +
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

std::string text_of(const Conditions& conditions) {
  std::string text = "{desired: ";
  text += conditions.desired == Conditions::Desired::Model ? "model" : "taught";
  return text + settings_text(conditions) + "}";
}

std::string text_of(const RunRules& rules) {
  return "{stops_out_of_view: " + std::string(rules.stops_out_of_view ? "true" : "false") +
         ", settled_steps: " + std::to_string(rules.settled_steps) +
         numbers_text(rule_keys(), rules) + "}";
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

std::string text_of(const PlannedOrder& order) {
  return "{scenario: " + quoted(order.scenario) + laws_text(order.laws) + "}";
}

}  // namespace

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text)
    out += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return out + '"';
}

std::string list(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + quoted(word);
  return "[" + text + "]";
}

std::string points_text(const std::vector<Eigen::Vector3d>& points) {
  std::string text;
  for (const Eigen::Vector3d& p : points) text += (text.empty() ? "" : ", ") + list(p);
  return "[" + text + "]";
}

std::string pose_text(const Eigen::Matrix3d& R, const Eigen::Vector3d& t) {
  const Eigen::Matrix3d rows = R.transpose();  // stored by columns
  return "{translation_m: " + list(t) +
         ", rotation: " + list(std::vector<double>(rows.data(), rows.data() + 9)) + "}";
}

std::string options_text(const LawOptions& options) {
  return std::string(", solver: ") + name(options.solver) +
         numbers_text(gain_keys(), options.gain) + numbers_text(law_keys(), options);
}

std::string text_of(const LabCamera& camera) {
  return "{focal_px: " + number(camera.focal_px) + ", principal_px: [" +
         number(camera.principal_u_px) + ", " + number(camera.principal_v_px) + "], size_px: [" +
         std::to_string(camera.width_px) + ", " + std::to_string(camera.height_px) + "]}";
}

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
  text += block("modifiers", plan.modifiers, modifier_text<Conditions>);
  text += block("maps", plan.maps, any);
  text += block("basins", plan.basins, any);
  text += block("margins", plan.margins, any);
  text += block("orders", plan.orders, any);
  if (!plan.helicopter.laws.empty()) text += text_of(plan.helicopter);
  return text;
}

std::string text_of(const CameraExperiment& experiment) {
  const CameraSetup& setup = experiment.setup;
  return text_of(PlannedLaw{experiment.law, setup.law}) + '\n' + full_text(setup.scenario) + '\n' +
         text_of(setup.camera) + '\n' + text_of(setup.conditions) + '\n' + text_of(setup.rules) +
         "\n" + experiment.modifier + " " + std::to_string(experiment.trace_every);
}

}  // namespace kestrel
