#include "kestrel/lab/lab_plan.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "kestrel/geometry/rotation.hpp"

#include "plan_keys.hpp"

namespace kestrel {
namespace {

[[noreturn]] void reject(const std::string& what) { throw std::invalid_argument("plan: " + what); }

/// Names stand in file names, in CSV and on the command line as they are.
void require_plain(const std::string& name) {
  constexpr const char* kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.+-=";
  if (name.empty() || name.front() == '.' || name.find_first_not_of(kPlain) != std::string::npos) {
    reject("'" + name + "' is no plain name; use letters, digits and _ . + - =");
  }
}

void require_once(std::set<std::string>& names, const std::string& name, const std::string& what) {
  require_plain(name);
  if (!names.insert(name).second) {
    reject("two of the " + what + " are called " + name + "; name one otherwise");
  }
}

void check_names(const LabPlan& plan) {
  std::set<std::string> laws;
  std::set<std::string> scenarios{"map", "basin", "margin", "order"};  // beginnings of other ids
  std::set<std::string> modifiers;
  std::set<std::string> flown_laws;
  std::set<std::string> flown_modifiers;
  std::set<std::string> maps;
  std::set<std::string> basins;
  for (const auto& law : plan.laws) require_once(laws, law.label, "laws");
  for (const auto& scenario : plan.scenarios) require_once(scenarios, scenario.name, "scenarios");
  for (const auto& scenario : plan.helicopter.scenarios) {
    require_once(scenarios, scenario.name, "scenarios");
  }
  for (const auto& law : plan.helicopter.laws) require_once(flown_laws, law.label, "laws");
  for (const auto& modifier : plan.helicopter.modifiers) {
    require_once(flown_modifiers, modifier.name, "modifiers");
  }
  for (const auto& modifier : plan.modifiers) require_once(modifiers, modifier.name, "modifiers");
  for (const auto& map : plan.maps) require_once(maps, map.name, "maps");
  for (const auto& basin : plan.basins) require_once(basins, basin.name, "basins");
}

void check_axis(const LabPlan& plan, const PlannedMap& map, const SweptKey& axis) {
  if (axis.values.empty())
    reject("map " + map.name + ": " + axis.key + " has no values; give some");
  for (const double value : axis.values) {
    if (axis.key != "rz_deg") with_setting(plan.conditions, {axis.key, value});
  }
}

void check_parts(const LabPlan& plan) {
  for (const PlannedModifier& modifier : plan.modifiers) {
    for (const std::string& name : modifier.scenarios) scenario_named(plan, name);
    laws_labelled(plan, modifier.laws);
    with_modifier(plan.conditions, modifier);
  }
  for (const PlannedMap& map : plan.maps) {
    scenario_named(plan, map.scenario);
    laws_labelled(plan, map.laws);
    check_axis(plan, map, map.x);
    check_axis(plan, map, map.y);
    if (map.x.key == map.y.key) reject("map " + map.name + ": x and y are both " + map.x.key);
  }
  for (const PlannedBasin& basin : plan.basins) {
    scenario_named(plan, basin.scenario);
    laws_labelled(plan, basin.laws);
    if (basin.starts.empty()) reject("basin " + basin.name + ": has no starts; give some");
  }
  for (const PlannedMargin& margin : plan.margins) {
    scenario_named(plan, margin.scenario);
    laws_labelled(plan, margin.laws);
  }
  for (const PlannedOrder& order : plan.orders) {
    scenario_named(plan, order.scenario);
    laws_labelled(plan, order.laws);
  }
  plan.helicopter.check();
}

}  // namespace

const Scenario& scenario_named(const LabPlan& plan, const std::string& name) {
  for (const Scenario& scenario : plan.scenarios) {
    if (scenario.name == name) return scenario;
  }
  reject("there is no scenario " + name + "; name one of its scenarios");
}

std::vector<PlannedLaw> laws_labelled(const LabPlan& plan, const std::vector<std::string>& labels) {
  for (const std::string& label : labels) {
    if (std::none_of(plan.laws.begin(), plan.laws.end(),
                     [&](const PlannedLaw& law) { return law.label == label; })) {
      reject("there is no law labelled " + label + "; name one of its laws");
    }
  }
  std::vector<PlannedLaw> laws;
  std::copy_if(plan.laws.begin(), plan.laws.end(), std::back_inserter(laws),
               [&](const PlannedLaw& law) {
                 return labels.empty() || std::count(labels.begin(), labels.end(), law.label) > 0;
               });
  return laws;
}

void LabPlan::check() const {
  const bool flies = !helicopter.laws.empty() && !helicopter.scenarios.empty();
  if ((laws.empty() || scenarios.empty()) && !flies) {
    reject("there is nothing to run; give laws and scenarios, or helicopter");
  }
  check_names(*this);
  camera.check();
  conditions.check();
  rules.check();
  if (trace_every < 0) reject("trace_every must be 0 (no traces) or more");
  if (!std::isfinite(settled_error) || settled_error < 0) {
    reject("settled_error must not be negative");
  }
  for (const PlannedLaw& law : laws) law.options.check();
  for (const Scenario& scenario : scenarios) scenario.check();
  check_parts(*this);
}

Scenario turned(Scenario scenario, double rz_deg) {
  const GoalFromCamera turn{rotation_from_vector({0, 0, rz_deg * kPlanDegree}), {0, 0, 0}};
  scenario.start = turn.inverse() * scenario.goal;
  return scenario;
}

}  // namespace kestrel
