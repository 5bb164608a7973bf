#pragma once

#include <string>
#include <vector>

#include "kestrel/lab/camera_run.hpp"
#include "kestrel/lab/helicopter_plan.hpp"
#include "kestrel/lab/plan_modifier.hpp"
#include "kestrel/lab/start_poses.hpp"

namespace kestrel {

/// A law with its options, under the label that its runs are filed under.
struct PlannedLaw {
  std::string label;
  LawOptions options;
};

/// A parameter of a map and the values it takes: a key of the conditions, or "rz_deg", the start's
/// pose turned by so much about the goal's optical axis and otherwise at the goal.
struct SweptKey {
  std::string key;
  std::vector<double> values;
};

/// Runs over two swept parameters.
struct PlannedMap {
  std::string name;
  std::string scenario;
  std::vector<std::string> laws;  // empty: all
  SweptKey x;
  SweptKey y;
};

/// Runs from many starts: each law's basin of attraction.
struct PlannedBasin {
  std::string name;
  std::string scenario;           // target and goal
  std::vector<std::string> laws;  // empty: all
  std::vector<StartPose> starts;
};

/// Gain and delay margins (lab/margins) from a scenario.
struct PlannedMargin {
  std::string scenario;
  std::vector<std::string> laws;  // empty: all
  bool gain = true;
  bool delay = true;
};

/// Orders of accuracy (lab/order_of_accuracy) at a scenario's goal.
struct PlannedOrder {
  std::string scenario;
  std::vector<std::string> laws;  // empty: all
};

/// All that a comparison runs: each law on each scenario, without and with the modifiers that
/// apply there, and beside that maps, basins, margins and orders of accuracy.
struct LabPlan {
  std::string title;
  std::vector<PlannedLaw> laws;
  std::vector<Scenario> scenarios;
  LabCamera camera{};
  Conditions conditions{};
  RunRules rules{};
  int trace_every = 1;  // of the runs; maps and basins keep no trace
  std::vector<PlannedModifier> modifiers;
  std::vector<PlannedMap> maps;
  std::vector<PlannedBasin> basins;
  std::vector<PlannedMargin> margins;
  std::vector<PlannedOrder> orders;
  PlannedHelicopter helicopter{};
  /// Settled runs of maps and basins end when |e| has stayed below this; 0: they run all steps.
  double settled_error = 1e-5;

  /// Throws std::invalid_argument that names what is wrong: nothing to run, a label, scenario or
  /// name given twice, one that is not there, a value out of range.
  void check() const;
};

/// The scenario of that name. Throws std::invalid_argument when the plan has none.
const Scenario& scenario_named(const LabPlan& plan, const std::string& name);

/// The laws of these labels in the plan's order; all when there are no labels.
std::vector<PlannedLaw> laws_labelled(const LabPlan& plan, const std::vector<std::string>& labels);

/// The scenario with its start at the goal, turned by this angle about the optical axis.
Scenario turned(Scenario scenario, double rz_deg);

}  // namespace kestrel
