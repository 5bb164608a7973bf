#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kestrel/eval/table.hpp"
#include "kestrel/lab/planned_runs.hpp"

namespace kestrel {

/// A run that was made, with its place in the plan.
struct MadeRun {
  LabPart part = LabPart::Table;
  std::size_t of = 0;
  std::size_t x = 0;
  std::size_t y = 0;
  LabRun run;
};

/// The runs that were made, in the plan's order.
std::vector<MadeRun> made_runs(const std::vector<PlannedRun>& planned,
                               std::vector<std::optional<LabRun>> runs);

/// A row for each run of the plan's tables: scenario, law, modifier, world, end, refusal, steps,
/// then every figure that any of them has (units in the names).
Table results_table(const std::vector<MadeRun>& runs);

/// Laws down, scenarios across (and for each scenario with modifiers a table of those): the step
/// from which |e| stays below the threshold (helicopter: the time it settles at, s), else the word
/// for the end.
std::vector<ReportTable> outcome_tables(const std::vector<MadeRun>& runs);

/// A share of trials with its 95 % interval (Wilson 1927), in [0, 1].
struct Share {
  double value = 0;
  double low = 0;
  double high = 1;
};
Share share_of(int successes, int trials);

/// A row for each basin and law: how many starts converged, of how many, percent, and the interval.
Table basin_table(const LabPlan& plan, const std::vector<MadeRun>& runs);

/// A row for each start and law of all basins: basin, start, law, end, refusal, steps, figures.
Table basin_run_table(const LabPlan& plan, const std::vector<MadeRun>& runs);

/// A row for each cell and law of one of the plan's maps: law, the two values, end, refusal, steps,
/// figures.
Table map_table(const LabPlan& plan, std::size_t map, const std::vector<MadeRun>& runs);

/// A row for each scenario and law: gain_limit_per_s, delay_limit_frames.
Table margin_table(const LabPlan& plan, const std::vector<MadeRun>& runs);

/// A row for each scenario and law: slope_to_screw, slope_to_straight_line (lab/order_of_accuracy).
Table order_table(const LabPlan& plan, const std::vector<MadeRun>& runs);

}  // namespace kestrel
