#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "kestrel/io/yaml_section.hpp"
#include "kestrel/lab/lab_plan.hpp"

#include "plan_keys.hpp"

/// The sections of a plan's file.
namespace kestrel {

/// What the numbers of these keys are where the section has them.
template <class Struct>
void read_numbers(const Section& section, const std::vector<NumberKey<Struct>>& keys,
                  Struct& into) {
  for (const NumberKey<Struct>& key : keys) {
    if (section.has(key.key)) into.*key.number = section.number(key.key) * key.unit;
  }
}

/// Does it, and blames this key of the file for what it finds out of range.
template <class Action>
void or_fail(const Section& section, const std::string& key, const Action& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    section.fail(key, error.what());
  }
}

/// {name, points_m or square_m, goal, start or start_in_goal}.
Scenario read_scenario(const Section& section);

/// The keys of conditions and `desired`, on top of these.
Conditions read_conditions(const Section& section, const Conditions& conditions);

/// A list of words ("kz2") and of {name, words, on, laws, keys of conditions, sweep}.
std::vector<PlannedModifier> read_modifiers(const Section& root, const std::string& key);

/// {name, scenario, laws, x, y}.
PlannedMap read_map(const Section& section);

/// {name, scenario, laws, file or poses, seed, box}; draws the starts.
PlannedBasin read_basin(const Section& section, const LabPlan& plan);

/// {scenario, laws, gain, delay}.
PlannedMargin read_margin(const Section& section);

/// {scenarios, laws, modifiers}.
PlannedHelicopter read_helicopter(const Section& section);

/// points_m or square_m.
std::vector<Eigen::Vector3d> read_points(const Section& section);

}  // namespace kestrel
