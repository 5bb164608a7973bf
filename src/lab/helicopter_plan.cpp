#include "kestrel/lab/helicopter_plan.hpp"

#include <algorithm>
#include <stdexcept>

#include "kestrel/lab/helicopter_benchmark.hpp"

namespace kestrel {
namespace {

[[noreturn]] void reject(const std::string& what) { throw std::invalid_argument("plan: " + what); }

template <class Part, class Name>
void require_known(const std::vector<std::string>& wanted, const std::vector<Part>& parts,
                   const Name& name_of, const char* what) {
  for (const std::string& name : wanted) {
    const auto is_it = [&](const Part& part) { return name_of(part) == name; };
    if (std::none_of(parts.begin(), parts.end(), is_it)) {
      reject("helicopter: there is no " + std::string(what) + " " + name + "; name one of its " +
             what + "s");
    }
  }
}

HelicopterConditions conditions_of(const PlannedHelicopter& planned,
                                   const PlannedHelicopterLaw& law,
                                   const PlannedModifier& modifier) {
  const PlannedModifier own{law.label, "", law.settings, {}, {}};
  return with_modifier(with_modifier(planned.conditions, own), modifier);
}

}  // namespace

void PlannedHelicopter::check() const {
  camera.check();
  conditions.check();
  rules.check();
  for (const HelicopterScenario& scenario : scenarios) scenario.check();
  for (const PlannedHelicopterLaw& law : laws) {
    law.options.check();
    conditions_of(*this, law, {});
  }
  for (const PlannedModifier& modifier : modifiers) {
    require_known(
        modifier.scenarios, scenarios, [](const auto& one) { return one.name; }, "scenario");
    require_known(
        modifier.laws, laws, [](const auto& one) { return one.label; }, "law");
    with_modifier(conditions, modifier);
  }
}

HelicopterExperiment planned_flight(const PlannedHelicopter& planned,
                                    const HelicopterScenario& scenario,
                                    const PlannedHelicopterLaw& law,
                                    const PlannedModifier& modifier) {
  HelicopterExperiment experiment;
  experiment.scenario = scenario.name;
  experiment.law = law.label;
  experiment.modifier = modifier.name;
  experiment.setup = {scenario, planned.camera, law.options, conditions_of(planned, law, modifier),
                      planned.rules};
  return experiment;
}

const std::vector<std::string>& helicopter_law_setting_keys() {
  static const std::vector<std::string> keys = [] {
    std::vector<std::string> found{"predicted", "feed_forward"};
    for (const std::string& key : helicopter_condition_keys()) {
      const bool is_limit = key.rfind("limit", 0) == 0 || key.rfind("acceleration_", 0) == 0;
      if (is_limit) found.push_back(key);
    }
    return found;
  }();
  return keys;
}

std::pair<HelicopterVariant, Law> helicopter_law_labelled(const std::string& label) {
  for (const HelicopterVariant variant : all_helicopter_variants()) {
    for (const Law law : all_laws()) {
      if (label == helicopter_law_label(variant, law)) {
        const bool is_mejias = variant == HelicopterVariant::Mejias;
        return {variant, is_mejias ? Law::Decoupled : law};
      }
    }
  }
  reject("there is no law " + label +
         " on a helicopter; write a variant and a law, vp4_des, or "
         "mejias");
}

PlannedHelicopterLaw benchmark_helicopter_law(const std::string& label) {
  const auto [variant, law] = helicopter_law_labelled(label);
  return {label, benchmark_helicopter_law(variant, law), {}};
}

}  // namespace kestrel
