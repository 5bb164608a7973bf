#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "kestrel/io/csv.hpp"
#include "kestrel/io/text_file.hpp"

/// The keys by which a plan changes conditions, of the free camera and of the helicopter.
namespace kestrel {

template <class C>
struct ConditionKey {
  std::string name;
  std::function<std::optional<double>(const C&)> get;  // empty when it is not set (gain, limits)
  std::function<void(C&, double)> set;
  std::vector<std::string> words;  // of a key that takes words: the value is the word's number
};

/// All keys of the conditions, in the order in which they are to be applied.
template <class C>
const std::vector<ConditionKey<C>>& condition_keys_of();

/// Throws std::invalid_argument for what is no whole number from 0 to the largest.
inline double whole(const std::string& key, double value, double largest) {
  if (value != std::floor(value) || value < 0 || value > largest) {
    throw std::invalid_argument(key + ": " + number(value) + " is no whole number from 0 to " +
                                number(largest) + "; write one");
  }
  return value;
}

template <class C>
ConditionKey<C> number_key(const std::string& name, double C::*value) {
  return {name,
          [value](const C& c) { return c.*value; },
          [value](C& c, double x) { c.*value = x; },
          {}};
}

template <class C>
ConditionKey<C> count_key(const std::string& name, int C::*value) {
  return {name,
          [value](const C& c) { return double(c.*value); },
          [name, value](C& c, double x) { c.*value = int(whole(name, x, 1e7)); },
          {}};
}

template <class C>
ConditionKey<C> gain_key() {
  return {"gain_per_s",
          [](const C& c) { return c.gain_per_s; },
          [](C& c, double x) { c.gain_per_s = x; },
          {}};
}

template <class C>
ConditionKey<C> seed_key() {
  return {"seed",
          [](const C& c) { return double(c.seed); },
          [](C& c, double x) { c.seed = std::uint64_t(whole("seed", x, 0x1p53)); },
          {}};
}

template <class C>
std::vector<std::string> names_of_keys() {
  std::vector<std::string> names;
  for (const ConditionKey<C>& key : condition_keys_of<C>()) names.push_back(key.name);
  return names;
}

/// Throws std::invalid_argument that names the nearest when there is none of that name.
template <class C>
const ConditionKey<C>& condition_key(const std::string& name) {
  for (const ConditionKey<C>& key : condition_keys_of<C>()) {
    if (key.name == name) return key;
  }
  const std::string near = nearest_word(name, names_of_keys<C>());
  throw std::invalid_argument(name + ": is no key of the conditions" +
                              (near.empty() ? "" : "; did you mean " + near + "?"));
}

/// The conditions with one key changed, checked.
template <class C>
C changed_by(C conditions, const std::string& name, double value) {
  const ConditionKey<C>& key = condition_key<C>(name);
  if (!key.words.empty()) whole(name, value, double(key.words.size() - 1));
  key.set(conditions, value);
  conditions.check();
  return conditions;
}

/// The value as a plan's file says it.
template <class C>
std::string setting_text(const std::string& name, double value) {
  const ConditionKey<C>& key = condition_key<C>(name);
  return key.words.empty() ? number(value) : key.words[std::size_t(value)];
}

}  // namespace kestrel
