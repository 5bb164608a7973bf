#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "kestrel/lab/lab_plan.hpp"

#include "condition_key.hpp"
#include "plan_keys.hpp"

/// Parts of a plan as YAML, every default written out.
namespace kestrel {

/// In quotes, with what is one in it escaped.
std::string quoted(const std::string& text);

template <class Numbers>
std::string list(const Numbers& numbers) {
  std::string text;
  for (const double value : numbers) text += (text.empty() ? "" : ", ") + number(value);
  return "[" + text + "]";
}

std::string list(const std::vector<std::string>& words);

/// A list of points: [[x, y, z], ...].
std::string points_text(const std::vector<Eigen::Vector3d>& points);

std::string pose_text(const Eigen::Matrix3d& R, const Eigen::Vector3d& t);

/// ", key: value" of each finite number.
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

/// ", key: value" of each key of the conditions that is set.
template <class C>
std::string settings_text(const C& conditions) {
  std::string text;
  for (const ConditionKey<C>& key : condition_keys_of<C>()) {
    if (const auto value = key.get(conditions)) {
      text += ", " + key.name + ": " + setting_text<C>(key.name, *value);
    }
  }
  return text;
}

template <class C>
std::string settings_text(const std::vector<ConditionSetting>& settings) {
  std::string text;
  for (const auto& [key, value] : settings) text += ", " + key + ": " + setting_text<C>(key, value);
  return text;
}

/// Of conditions C.
template <class C>
std::string modifier_text(const PlannedModifier& modifier) {
  std::string text = "{name: " + quoted(modifier.name);
  if (!modifier.words.empty()) text += ", words: " + quoted(modifier.words);
  text += settings_text<C>(modifier.settings);
  if (!modifier.scenarios.empty()) text += ", on: " + list(modifier.scenarios);
  if (!modifier.laws.empty()) text += ", laws: " + list(modifier.laws);
  return text + "}";
}

/// ", solver: ..." and the numbers of the options.
std::string options_text(const LawOptions& options);

std::string text_of(const LabCamera& camera);

/// "KEY:" and a line for each part; nothing when there are none.
template <class Part, class Text>
std::string block(const std::string& key, const std::vector<Part>& parts, const Text& text) {
  if (parts.empty()) return "";
  const std::string indent(key.find_first_not_of(' '), ' ');
  std::string lines = key + ":\n";
  for (const Part& part : parts) lines += indent + "  - " + text(part) + '\n';
  return lines;
}

/// The section of the helicopter.
std::string text_of(const PlannedHelicopter& planned);

}  // namespace kestrel
