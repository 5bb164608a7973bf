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

/// {name, scenario, laws, x, y}.
PlannedMap read_map(const Section& section);

/// {name, scenario, laws, file or poses, seed, box}; draws the starts.
PlannedBasin read_basin(const Section& section, const LabPlan& plan);

/// {scenario, laws, gain, delay}.
PlannedMargin read_margin(const Section& section);

/// {scenario, laws}.
PlannedOrder read_order(const Section& section);

/// {scenarios, laws, camera, conditions, rules, modifiers}; without a camera of its own the plan's.
PlannedHelicopter read_helicopter(const Section& section, const LabCamera& camera);

/// {focal_px, principal_px, size_px}.
LabCamera read_camera(const Section& section);

/// Solver, gains and the numbers of LawOptions, where the section has them.
LawOptions read_law_options(const Section& section, LawOptions options);

/// The law of that name; fails with the nearest when there is none.
Law law_of(const Section& section, const std::string& key, const std::string& word);

/// Fails: there is no such thing of this name; did you mean the nearest, or one of the list?
[[noreturn]] void fail_unknown(const Section& section, const std::string& key,
                               const std::string& what, const std::string& word,
                               const std::vector<std::string>& known);

/// The words of the key; none for "all" or when the section has no such key.
std::vector<std::string> words_if(const Section& section, const std::string& key);

/// points_m or square_m.
std::vector<Eigen::Vector3d> read_points(const Section& section);

}  // namespace kestrel
