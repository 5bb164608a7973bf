#include "kestrel/lab/plan_modifier.hpp"

#include <algorithm>

#include "condition_key.hpp"

namespace kestrel {
namespace {

bool is_among(const std::vector<std::string>& names, const std::string& name) {
  return names.empty() || std::count(names.begin(), names.end(), name) > 0;
}

template <class C>
C changed_by(const C& conditions, const PlannedModifier& modifier) {
  C changed = modified(conditions, modifier.words);
  for (const ConditionSetting& setting : modifier.settings) {
    changed = with_setting(changed, setting);
  }
  return changed;
}

}  // namespace

bool applies(const PlannedModifier& modifier, const std::string& scenario, const std::string& law) {
  return is_among(modifier.scenarios, scenario) && is_among(modifier.laws, law);
}

const std::vector<std::string>& condition_keys() {
  static const std::vector<std::string> names = names_of_keys<Conditions>();
  return names;
}

const std::vector<std::string>& helicopter_condition_keys() {
  static const std::vector<std::string> names = names_of_keys<HelicopterConditions>();
  return names;
}

Conditions with_setting(const Conditions& conditions, const ConditionSetting& setting) {
  return changed_by(conditions, setting.first, setting.second);
}

HelicopterConditions with_setting(const HelicopterConditions& conditions,
                                  const ConditionSetting& setting) {
  return changed_by(conditions, setting.first, setting.second);
}

Conditions with_modifier(const Conditions& conditions, const PlannedModifier& modifier) {
  return changed_by(conditions, modifier);
}

HelicopterConditions with_modifier(const HelicopterConditions& conditions,
                                   const PlannedModifier& modifier) {
  return changed_by(conditions, modifier);
}

}  // namespace kestrel
