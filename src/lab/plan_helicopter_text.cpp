#include <algorithm>

#include "kestrel/lab/lab_plan_file.hpp"

#include "plan_text_parts.hpp"

namespace kestrel {
namespace {

std::string full_text(const HelicopterScenario& s) {
  return "{name: " + quoted(s.name) + ", points_m: " + points_text(s.points_m) +
         ", goal: " + pose_text(s.goal.rotation, s.goal.translation) +
         ", start_camera_m: " + list(s.start_camera_m) +
         ", start_yaw_deg: " + number(in_unit(s.start_yaw_rad, kPlanDegree)) +
         ", target_velocity_m_s: " + list(s.target_velocity_m_s) + ", body_from_camera: " +
         pose_text(s.body_from_camera.rotation, s.body_from_camera.translation) +
         ", world_from_target: " +
         pose_text(s.world_from_target.rotation, s.world_from_target.translation) + "}";
}

/// The name alone where that says it all.
std::string short_text(const HelicopterScenario& scenario) {
  const std::vector<HelicopterScenario>& known = helicopter_scenarios();
  const bool is_known = std::any_of(known.begin(), known.end(), [&](const auto& candidate) {
    return full_text(candidate) == full_text(scenario);
  });
  return is_known ? quoted(scenario.name) : full_text(scenario);
}

std::string text_of(const PlannedHelicopterLaw& law) {
  const HelicopterLawOptions& options = law.options;
  std::string text = "{label: " + quoted(law.label) + ", variant: " + name(options.variant);
  if (options.variant != HelicopterVariant::Mejias) {
    text += ", law: " + quoted(name(options.law.law));
  }
  return text + options_text(options.law) +
         ", heading_gain_per_s: " + number(options.heading_gain_per_s) +
         settings_text<HelicopterConditions>(law.settings) + "}";
}

std::string text_of(const HelicopterConditions& conditions) {
  return "{" + settings_text(conditions).substr(2) + "}";
}

std::string text_of(const HelicopterRules& rules) {
  return "{stops_out_of_view: " + std::string(rules.stops_out_of_view ? "true" : "false") +
         numbers_text(helicopter_rule_keys(), rules) + "}";
}

}  // namespace

std::string text_of(const PlannedHelicopter& planned) {
  return "helicopter:\n  camera: " + text_of(planned.camera) +
         "\n  conditions: " + text_of(planned.conditions) + "\n  rules: " + text_of(planned.rules) +
         '\n' + block("  scenarios", planned.scenarios, short_text) +
         block("  laws", planned.laws,
               [](const PlannedHelicopterLaw& law) { return text_of(law); }) +
         block("  modifiers", planned.modifiers, modifier_text<HelicopterConditions>);
}

std::string text_of(const HelicopterExperiment& experiment) {
  const HelicopterSetup& setup = experiment.setup;
  return text_of(PlannedHelicopterLaw{experiment.law, setup.law, {}}) + '\n' +
         full_text(setup.scenario) + '\n' + text_of(setup.camera) + '\n' +
         text_of(setup.conditions) + '\n' + text_of(setup.rules) + '\n' + experiment.modifier +
         ' ' + std::to_string(experiment.trace_every);
}

}  // namespace kestrel
