#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "kestrel/lab/plan_modifier.hpp"

#include "condition_key.hpp"
#include "plan_parts.hpp"

/// What a plan's file says of conditions: those of the free camera and those of the helicopter are
/// read the same way.
namespace kestrel {

/// The number of a word among those of the key.
inline double word_number(const Section& section, const std::string& key,
                          const std::vector<std::string>& words, const std::string& word) {
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end()) {
    std::string list;
    for (const std::string& one : words) list += (list.empty() ? "" : " or ") + one;
    section.fail(key, "'" + word + "' is not understood; write " + list);
  }
  return double(found - words.begin());
}

/// The values of a list under this key of the conditions.
template <class C>
std::vector<double> read_values(const Section& section, const std::string& key) {
  const std::vector<std::string>& words = condition_key<C>(key).words;
  if (words.empty()) return section.numbers(key);
  std::vector<double> values;
  for (const std::string& word : section.words(key)) {
    values.push_back(word_number(section, key, words, word));
  }
  return values;
}

/// Those of these keys that the section has, in their order.
template <class C>
std::vector<ConditionSetting> read_settings(const Section& section,
                                            const std::vector<std::string>& keys) {
  std::vector<ConditionSetting> settings;
  for (const std::string& key : keys) {
    if (!section.has(key)) continue;
    const std::vector<std::string>& words = condition_key<C>(key).words;
    const double value =
        words.empty() ? section.number(key) : word_number(section, key, words, section.text(key));
    settings.emplace_back(key, value);
    or_fail(section, key, [&] { with_setting(C{}, settings.back()); });
  }
  return settings;
}

/// The same in the order in which the keys are to be applied.
template <class C>
std::vector<ConditionSetting> in_order(const std::vector<ConditionSetting>& settings) {
  std::vector<ConditionSetting> sorted;
  for (const ConditionKey<C>& key : condition_keys_of<C>()) {
    for (const ConditionSetting& setting : settings) {
      if (setting.first == key.name) sorted.push_back(setting);
    }
  }
  return sorted;
}

/// Every combination of the swept values, the last key's changing fastest.
template <class C>
std::vector<PlannedModifier> swept(const Section& sweep, const PlannedModifier& modifier) {
  std::vector<PlannedModifier> all{modifier};
  for (const std::string& key : sweep.keys()) {
    or_fail(sweep, key, [&] { condition_key<C>(key); });
    for (const ConditionSetting& setting : modifier.settings) {
      if (setting.first == key) sweep.fail(key, "is set beside the sweep; remove one of the two");
    }
    std::vector<PlannedModifier> longer;
    for (const PlannedModifier& before : all) {
      for (const double value : read_values<C>(sweep, key)) {
        longer.push_back(before);
        PlannedModifier& now = longer.back();
        now.settings.emplace_back(key, value);
        or_fail(sweep, key, [&] { with_setting(C{}, now.settings.back()); });
        now.name += (now.name.empty() ? "" : "_") + key + "=" + setting_text<C>(key, value);
      }
    }
    all = std::move(longer);
  }
  for (PlannedModifier& one : all) one.settings = in_order<C>(one.settings);
  return all;
}

/// {name, words, on, laws, keys of the conditions, sweep}.
template <class C>
std::vector<PlannedModifier> read_modifier(const Section& section) {
  PlannedModifier modifier;
  modifier.words = section.text("words", "");
  const bool is_swept = section.has("sweep");
  modifier.name = is_swept ? section.text("name", "") : section.text("name");
  or_fail(section, "words", [&] { modified(C{}, modifier.words); });
  modifier.settings = read_settings<C>(section, names_of_keys<C>());
  modifier.scenarios = words_if(section, "on");
  modifier.laws = words_if(section, "laws");
  return is_swept ? swept<C>(section.child("sweep"), modifier) : std::vector{modifier};
}

/// A list of words ("kz2") and of modifiers with keys.
template <class C>
std::vector<PlannedModifier> read_modifiers(const Section& root) {
  std::vector<PlannedModifier> all;
  if (!root.has("modifiers")) return all;
  for (const SectionItem& item : root.items("modifiers")) {
    if (item.keys) {
      for (PlannedModifier& modifier : read_modifier<C>(*item.keys)) {
        all.push_back(std::move(modifier));
      }
    } else {
      or_fail(root, "modifiers", [&] { modified(C{}, item.word); });
      all.push_back({item.word, item.word, {}, {}, {}});
    }
  }
  return all;
}

}  // namespace kestrel
