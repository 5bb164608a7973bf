#include "kestrel/lab/planned_runs.hpp"

#include <utility>

#include "kestrel/lab/camera_experiment.hpp"
#include "kestrel/lab/lab_plan_file.hpp"
#include "kestrel/lab/margins.hpp"
#include "kestrel/lab/order_of_accuracy.hpp"

namespace kestrel {
namespace {

/// The run of a margin: its one figure, and whether there is one.
LabRun margin_run(const CameraExperiment& experiment, const std::string& what) {
  const bool is_gain = what == "gain";
  LabRun run;
  run.scenario = experiment.scenario;
  run.law = experiment.law;
  run.modifier = experiment.modifier;
  std::optional<double> limit;
  if (is_gain) {
    limit = gain_margin(experiment.setup, {});
  } else if (const auto frames = delay_margin(experiment.setup, {})) {
    limit = *frames;
  }
  run.end = limit ? RunEnd::Converged : RunEnd::Diverged;
  run.metrics = {{is_gain ? "gain_limit_per_s" : "delay_limit_frames", limit}};
  return run;
}

/// The run of an order: its one figure, and whether there is one.
LabRun order_run(const CameraExperiment& experiment, IdealTwist ideal) {
  LabRun run;
  run.scenario = experiment.scenario;
  run.law = experiment.law;
  run.modifier = experiment.modifier;
  AccuracyOptions options;
  options.ideal = ideal;
  const std::optional<double> slope = order_of_accuracy(experiment.setup, options);
  run.end = slope ? RunEnd::Converged : RunEnd::Refused;
  run.metrics = {{"slope_to_" + experiment.modifier, slope}};
  return run;
}

/// Expands a plan, part by part.
class Expansion {
 public:
  Expansion(const LabPlan& plan, std::string program, LabClock clock)
      : plan_(plan), program_(std::move(program)), clock_(std::move(clock)) {}

  void add_table() {
    for (const Scenario& scenario : plan_.scenarios) {
      add_laws(scenario, {});
      for (const PlannedModifier& modifier : plan_.modifiers) {
        add_laws(scenario, modifier);
      }
    }
  }

  void add_helicopter() {
    for (const HelicopterScenario& scenario : plan_.helicopter.scenarios) {
      add_flights(scenario, {});
      for (const PlannedModifier& modifier : plan_.helicopter.modifiers) {
        add_flights(scenario, modifier);
      }
    }
  }

  void add_maps() {
    for (std::size_t i = 0; i < plan_.maps.size(); ++i) {
      const PlannedMap& map = plan_.maps[i];
      for (const PlannedLaw& law : laws_labelled(plan_, map.laws)) {
        for (std::size_t y = 0; y < map.y.values.size(); ++y) {
          for (std::size_t x = 0; x < map.x.values.size(); ++x) add_cell(i, law, x, y);
        }
      }
    }
  }

  void add_basins() {
    for (std::size_t i = 0; i < plan_.basins.size(); ++i) {
      const PlannedBasin& basin = plan_.basins[i];
      for (const PlannedLaw& law : laws_labelled(plan_, basin.laws)) {
        for (std::size_t x = 0; x < basin.starts.size(); ++x) {
          const Scenario& goal = scenario_named(plan_, basin.scenario);
          const auto experiment =
              settled({basin.name, law.label, std::to_string(x), {}, 0},
                      started_from(goal, basin.starts[x]), law, plan_.conditions);
          add({LabPart::Basin, i, law.label, x, 0,
               job("basin/" + basin.name + "/" + law.label + "/" + std::to_string(x), experiment)});
        }
      }
    }
  }

  void add_margins() {
    for (std::size_t i = 0; i < plan_.margins.size(); ++i) {
      const PlannedMargin& margin = plan_.margins[i];
      for (const PlannedLaw& law : laws_labelled(plan_, margin.laws)) {
        if (margin.gain) add_margin(i, law, "gain");
        if (margin.delay) add_margin(i, law, "delay");
      }
    }
  }

  void add_orders() {
    for (std::size_t i = 0; i < plan_.orders.size(); ++i) {
      for (const PlannedLaw& law : laws_labelled(plan_, plan_.orders[i].laws)) {
        add_order(i, law, IdealTwist::Screw);
        add_order(i, law, IdealTwist::StraightLine);
      }
    }
  }

  std::vector<PlannedRun> runs() { return std::move(runs_); }

 private:
  void add(PlannedRun run) { runs_.push_back(std::move(run)); }

  CameraExperiment of(CameraExperiment labels, const Scenario& scenario, const PlannedLaw& law,
                      const Conditions& conditions) const {
    labels.setup = {scenario, plan_.camera, law.options, conditions, plan_.rules};
    return labels;
  }

  /// The same for runs that end once they have settled.
  CameraExperiment settled(CameraExperiment labels, const Scenario& scenario, const PlannedLaw& law,
                           const Conditions& conditions) const {
    CameraExperiment experiment = of(std::move(labels), scenario, law, conditions);
    experiment.setup.rules.settled_error = plan_.settled_error;
    return experiment;
  }

  template <class Experiment>
  LabJob job(const std::string& id, const Experiment& experiment) const {
    return {id, program_ + '\n' + text_of(experiment),
            [experiment, clock = clock_] { return run(experiment, clock); }};
  }

  void add_laws(const Scenario& scenario, const PlannedModifier& modifier) {
    const Conditions conditions = with_modifier(plan_.conditions, modifier);
    for (const PlannedLaw& law : plan_.laws) {
      if (!applies(modifier, scenario.name, law.label)) continue;
      const auto experiment = of({scenario.name, law.label, modifier.name, {}, plan_.trace_every},
                                 scenario, law, conditions);
      add({LabPart::Table, 0, law.label, 0, 0, job(experiment.id(), experiment)});
    }
  }

  void add_flights(const HelicopterScenario& scenario, const PlannedModifier& modifier) {
    for (const PlannedHelicopterLaw& law : plan_.helicopter.laws) {
      if (!applies(modifier, scenario.name, law.label)) continue;
      HelicopterExperiment experiment = planned_flight(plan_.helicopter, scenario, law, modifier);
      experiment.trace_every = plan_.trace_every;
      add({LabPart::Table, 0, law.label, 0, 0, job(experiment.id(), experiment)});
    }
  }

  void add_cell(std::size_t i, const PlannedLaw& law, std::size_t x, std::size_t y) {
    const PlannedMap& map = plan_.maps[i];
    Scenario scenario = scenario_named(plan_, map.scenario);
    Conditions conditions = plan_.conditions;
    for (const auto& [key, value] :
         {std::pair(map.x.key, map.x.values[x]), std::pair(map.y.key, map.y.values[y])}) {
      if (key == "rz_deg") {
        scenario = turned(scenario, value);
      } else {
        conditions = with_setting(conditions, {key, value});
      }
    }
    const std::string cell = "x" + std::to_string(x) + "_y" + std::to_string(y);
    add({LabPart::Map, i, law.label, x, y,
         job("map/" + map.name + "/" + law.label + "/" + cell,
             settled({map.name, law.label, cell, {}, 0}, scenario, law, conditions))});
  }

  void add_margin(std::size_t i, const PlannedLaw& law, const std::string& what) {
    const Scenario& scenario = scenario_named(plan_, plan_.margins[i].scenario);
    const auto experiment =
        of({scenario.name, law.label, what, {}, 0}, scenario, law, plan_.conditions);
    LabJob made = job("margin/" + scenario.name + "/" + law.label + "/" + what, experiment);
    made.run = [experiment, what] { return margin_run(experiment, what); };
    add({LabPart::Margin, i, law.label, 0, 0, std::move(made)});
  }

  void add_order(std::size_t i, const PlannedLaw& law, IdealTwist ideal) {
    const Scenario& scenario = scenario_named(plan_, plan_.orders[i].scenario);
    const std::string what = ideal == IdealTwist::Screw ? "screw" : "straight_line";
    const auto experiment =
        of({scenario.name, law.label, what, {}, 0}, scenario, law, plan_.conditions);
    LabJob made = job("order/" + scenario.name + "/" + law.label + "/" + what, experiment);
    made.run = [experiment, ideal] { return order_run(experiment, ideal); };
    add({LabPart::Order, i, law.label, 0, 0, std::move(made)});
  }

  const LabPlan& plan_;
  std::string program_;
  LabClock clock_;
  std::vector<PlannedRun> runs_;
};

}  // namespace

std::vector<PlannedRun> planned_runs(const LabPlan& plan, const std::string& program,
                                     const LabClock& clock) {
  plan.check();
  Expansion expansion(plan, program, clock);
  expansion.add_table();
  expansion.add_helicopter();
  expansion.add_maps();
  expansion.add_basins();
  expansion.add_margins();
  expansion.add_orders();
  return expansion.runs();
}

std::vector<LabJob> jobs_of(const std::vector<PlannedRun>& runs) {
  std::vector<LabJob> jobs;
  jobs.reserve(runs.size());
  for (const PlannedRun& run : runs) jobs.push_back(run.job);
  return jobs;
}

}  // namespace kestrel
