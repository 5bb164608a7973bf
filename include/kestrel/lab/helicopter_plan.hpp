#pragma once

#include <string>
#include <utility>
#include <vector>

#include "kestrel/lab/helicopter_experiment.hpp"
#include "kestrel/lab/plan_modifier.hpp"

namespace kestrel {

/// A law on a helicopter with its options, under the label that its runs are filed under.
struct PlannedHelicopterLaw {
  std::string label;
  HelicopterLawOptions options{};
  /// Conditions that go with this law: predicted, feed_forward, limits and accelerations. Applied
  /// after the plan's conditions and before a modifier.
  std::vector<ConditionSetting> settings;
};

/// Runs on the helicopter: each law in each scenario, without and with the modifiers that apply.
struct PlannedHelicopter {
  std::vector<HelicopterScenario> scenarios;
  std::vector<PlannedHelicopterLaw> laws;
  LabCamera camera{};
  HelicopterConditions conditions{};
  HelicopterRules rules{};
  std::vector<PlannedModifier> modifiers;

  /// Throws std::invalid_argument that names what is wrong: a scenario or law that a modifier names
  /// and that is not there, a value out of range.
  void check() const;
};

/// The run of a law on a scenario under the conditions that the modifier leaves; an empty modifier
/// changes nothing. Throws as with_modifier.
HelicopterExperiment planned_flight(const PlannedHelicopter& planned,
                                    const HelicopterScenario& scenario,
                                    const PlannedHelicopterLaw& law,
                                    const PlannedModifier& modifier);

/// The keys that a law's settings may take.
const std::vector<std::string>& helicopter_law_setting_keys();

/// A law on the helicopter by its label ("vp3_hh_mean", "mejias"). Throws std::invalid_argument
/// when there is none.
std::pair<HelicopterVariant, Law> helicopter_law_labelled(const std::string& label);

/// The same as the benchmark runs it.
PlannedHelicopterLaw benchmark_helicopter_law(const std::string& label);

}  // namespace kestrel
