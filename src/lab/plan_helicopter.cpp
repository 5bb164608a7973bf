#include <algorithm>

#include "kestrel/io/mount_file.hpp"
#include "kestrel/lab/helicopter_benchmark.hpp"

#include "plan_parts.hpp"
#include "plan_settings.hpp"

namespace kestrel {
namespace {

constexpr const char* kAll = "all";

Eigen::Vector3d vector(const Section& section, const std::string& key) {
  const std::vector<double> n = section.numbers(key, 3);
  return {n[0], n[1], n[2]};
}

HelicopterScenario read_flight(const Section& section) {
  HelicopterScenario scenario;
  scenario.name = section.text("name");
  scenario.points_m = read_points(section);
  scenario.goal = read_pose<frame::Camera, frame::Target>(section.child("goal"));
  scenario.start_camera_m = vector(section, "start_camera_m");
  scenario.start_yaw_rad = section.number("start_yaw_deg", 0) * kPlanDegree;
  if (section.has("target_velocity_m_s")) {
    scenario.target_velocity_m_s = vector(section, "target_velocity_m_s");
  }
  if (section.has("body_from_camera")) {
    scenario.body_from_camera =
        read_pose<frame::Body, frame::Camera>(section.child("body_from_camera"));
  }
  if (section.has("world_from_target")) {
    const auto read = read_pose<frame::Camera, frame::Target>(section.child("world_from_target"));
    scenario.world_from_target = {read.rotation, read.translation};
  }
  or_fail(section, "", [&] { scenario.check(); });
  return scenario;
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const HelicopterScenario& scenario : helicopter_scenarios()) all.push_back(scenario.name);
  return all;
}

std::vector<HelicopterScenario> read_flights(const Section& section) {
  const std::vector<HelicopterScenario>& known = helicopter_scenarios();
  if (!section.has("scenarios")) return known;
  std::vector<HelicopterScenario> scenarios;
  for (const SectionItem& item : section.items("scenarios")) {
    if (item.keys) {
      scenarios.push_back(read_flight(*item.keys));
    } else if (item.word == kAll) {
      scenarios.insert(scenarios.end(), known.begin(), known.end());
    } else {
      const auto found = std::find_if(known.begin(), known.end(), [&](const auto& scenario) {
        return scenario.name == item.word;
      });
      if (found == known.end()) fail_unknown(section, "scenarios", "scenario", item.word, names());
      scenarios.push_back(*found);
    }
  }
  return scenarios;
}

/// Those of the benchmark, each once, in its order.
std::vector<std::string> benchmark_labels() {
  std::vector<std::string> labels;
  for (const HelicopterExperiment& experiment : helicopter_benchmark()) {
    if (std::count(labels.begin(), labels.end(), experiment.law) == 0) {
      labels.push_back(experiment.law);
    }
  }
  return labels;
}

HelicopterVariant variant_of(const Section& section) {
  const std::string word = section.text("variant");
  if (const auto variant = helicopter_variant_named(word)) return *variant;
  std::vector<std::string> known;
  for (const HelicopterVariant one : all_helicopter_variants()) known.emplace_back(name(one));
  fail_unknown(section, "variant", "variant", word, known);
}

/// The law inside the variant; that of mejias is its own.
Law law_inside(const Section& section, HelicopterVariant variant) {
  if (variant == HelicopterVariant::Mejias) {
    if (section.has("law")) section.fail("law", "mejias is a law of its own; remove the key");
    return Law::Decoupled;
  }
  return law_of(section, "law", section.text("law"));
}

PlannedHelicopterLaw read_flown_law(const Section& section) {
  const HelicopterVariant variant = variant_of(section);
  const Law law = law_inside(section, variant);
  PlannedHelicopterLaw planned;
  planned.label = section.text("label", helicopter_law_label(variant, law));
  HelicopterLawOptions& options = planned.options;
  options = benchmark_helicopter_law(variant, law);
  options.law = read_law_options(section, options.law);
  // One gain for the image and the heading unless the heading has its own.
  options.heading_gain_per_s = section.number(
      "heading_gain_per_s", section.number("gain_per_s", options.heading_gain_per_s));
  planned.settings = read_settings<HelicopterConditions>(section, helicopter_law_setting_keys());
  or_fail(section, "", [&] { options.check(); });
  return planned;
}

std::vector<PlannedHelicopterLaw> read_flown_laws(const Section& section) {
  std::vector<PlannedHelicopterLaw> laws;
  const auto add_all = [&] {
    for (const std::string& label : benchmark_labels()) {
      laws.push_back(benchmark_helicopter_law(label));
    }
  };
  if (!section.has("laws")) {
    add_all();
    return laws;
  }
  for (const SectionItem& item : section.items("laws")) {
    if (item.keys) {
      laws.push_back(read_flown_law(*item.keys));
    } else if (item.word == kAll) {
      add_all();
    } else {
      or_fail(section, "laws", [&] { laws.push_back(benchmark_helicopter_law(item.word)); });
    }
  }
  return laws;
}

HelicopterConditions read_flight_conditions(const Section& section) {
  HelicopterConditions conditions;
  const auto settings = read_settings<HelicopterConditions>(section, helicopter_condition_keys());
  for (const ConditionSetting& setting : settings) conditions = with_setting(conditions, setting);
  return conditions;
}

HelicopterRules read_flight_rules(const Section& section) {
  HelicopterRules rules;
  read_numbers(section, helicopter_rule_keys(), rules);
  rules.stops_out_of_view = section.flag("stops_out_of_view", rules.stops_out_of_view);
  or_fail(section, "", [&] { rules.check(); });
  return rules;
}

}  // namespace

PlannedHelicopter read_helicopter(const Section& section, const LabCamera& camera) {
  PlannedHelicopter planned;
  planned.scenarios = read_flights(section);
  planned.laws = read_flown_laws(section);
  planned.camera = camera;
  if (const auto own = section.child_if("camera")) planned.camera = read_camera(*own);
  if (const auto keys = section.child_if("conditions")) {
    planned.conditions = read_flight_conditions(*keys);
  }
  if (const auto keys = section.child_if("rules")) planned.rules = read_flight_rules(*keys);
  planned.modifiers = read_modifiers<HelicopterConditions>(section);
  return planned;
}

}  // namespace kestrel
