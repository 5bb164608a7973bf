#include "kestrel/lab/lab_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "kestrel/lab/lab_report.hpp"

#include "table_rows.hpp"

namespace kestrel {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
using Row = std::vector<SummaryValue>;

/// End, refusal, steps and figures of runs below one head.
class Figures {
 public:
  explicit Figures(const std::vector<const MadeRun*>& runs) {
    for (const MadeRun* made : runs) {
      for (const auto& metric : made->run.metrics) place(names_, metric.first);
    }
  }

  Table table(const std::vector<std::string>& first) const {
    Table table;
    for (const std::string& name : first) table.columns.push_back({name, 4});
    for (const char* name : {"end", "refusal", "steps"}) table.columns.push_back({name});
    for (const std::string& name : names_) table.columns.push_back({name, 4});
    return table;
  }

  Row row(Row first, const LabRun& run) const {
    first.emplace_back(std::string(name(run.end)));
    first.emplace_back(run.end == RunEnd::Refused ? std::string(name(run.refusal)) : "");
    first.emplace_back(std::int64_t(run.steps));
    const std::size_t begin = first.size();
    first.resize(begin + names_.size(), kNone);
    for (const auto& [metric, value] : run.metrics) {
      const auto at = std::find(names_.begin(), names_.end(), metric) - names_.begin();
      if (value) first[begin + std::size_t(at)] = *value;
    }
    return first;
  }

 private:
  std::vector<std::string> names_;
};

/// A row for each scenario and law: the two figures of its runs, which follow one another.
template <class ScenarioOf>
void add_pairs(Table& table, const std::vector<const MadeRun*>& runs,
               const ScenarioOf& scenario_of) {
  for (const MadeRun* made : runs) {
    const LabRun& run = made->run;
    const std::string scenario = scenario_of(*made);
    if (table.rows.empty() || table.rows.back()[0] != SummaryValue(scenario) ||
        table.rows.back()[1] != SummaryValue(run.law)) {
      table.rows.push_back({scenario, run.law, kNone, kNone});
    }
    for (std::size_t column : {2, 3}) {
      const auto value = figure(run, table.columns[column].name);
      if (value) table.rows.back()[column] = *value;
    }
  }
}

}  // namespace

std::vector<MadeRun> made_runs(const std::vector<PlannedRun>& planned,
                               std::vector<std::optional<LabRun>> runs) {
  std::vector<MadeRun> made;
  for (std::size_t i = 0; i < planned.size(); ++i) {
    const PlannedRun& plan = planned[i];
    if (runs[i]) made.push_back({plan.part, plan.of, plan.x, plan.y, std::move(*runs[i])});
  }
  return made;
}

Table results_table(const std::vector<MadeRun>& runs) {
  const auto chosen = of_part(runs, LabPart::Table);
  const Figures figures(chosen);
  Table table = figures.table({"scenario", "law", "modifier", "world"});
  for (const MadeRun* made : chosen) {
    const LabRun& run = made->run;
    const std::string world = run.kind == RunKind::Helicopter ? "helicopter" : "camera";
    table.rows.push_back(figures.row({run.scenario, run.law, run.modifier, world}, run));
  }
  return table;
}

Share share_of(int successes, int trials) {
  if (trials < 1) return {kNone, 0, 1};
  constexpr double kZ = 1.959963984540054;  // of 95 %
  const double n = trials;
  const double p = successes / n;
  const double middle = (p + kZ * kZ / (2 * n)) / (1 + kZ * kZ / n);
  const double half = kZ * std::sqrt(p * (1 - p) / n + kZ * kZ / (4 * n * n)) / (1 + kZ * kZ / n);
  return {p, std::max(0., middle - half), std::min(1., middle + half)};
}

std::vector<BasinCount> basin_counts(const std::vector<MadeRun>& runs) {
  std::vector<BasinCount> counts;
  std::vector<std::string> keys;
  for (const MadeRun* made : of_part(runs, LabPart::Basin)) {
    const std::size_t at = place(keys, std::to_string(made->of) + "/" + made->run.law);
    if (at == counts.size()) counts.push_back({made->of, made->run.law, 0, 0});
    counts[at].converged += made->run.end == RunEnd::Converged;
    ++counts[at].starts;
  }
  return counts;
}

Table basin_table(const LabPlan& plan, const std::vector<MadeRun>& runs) {
  Table table{{{"basin"},
               {"law"},
               {"converged"},
               {"starts"},
               {"share_percent", 1},
               {"low_percent", 1},
               {"high_percent", 1}},
              {}};
  for (const BasinCount& count : basin_counts(runs)) {
    const Share share = share_of(count.converged, count.starts);
    table.rows.push_back({plan.basins[count.basin].name, count.law, std::int64_t(count.converged),
                          std::int64_t(count.starts), 100 * share.value, 100 * share.low,
                          100 * share.high});
  }
  return table;
}

Table basin_run_table(const LabPlan& plan, const std::vector<MadeRun>& runs) {
  const auto chosen = of_part(runs, LabPart::Basin);
  const Figures figures(chosen);
  Table table = figures.table({"basin", "start", "law"});
  for (const MadeRun* made : chosen) {
    table.rows.push_back(
        figures.row({plan.basins[made->of].name, std::int64_t(made->x), made->run.law}, made->run));
  }
  return table;
}

Table map_table(const LabPlan& plan, std::size_t map, const std::vector<MadeRun>& runs) {
  std::vector<const MadeRun*> chosen;
  for (const MadeRun* made : of_part(runs, LabPart::Map)) {
    if (made->of == map) chosen.push_back(made);
  }
  const SweptKey& x = plan.maps[map].x;
  const SweptKey& y = plan.maps[map].y;
  const Figures figures(chosen);
  Table table = figures.table({"law", x.key, y.key});
  for (const MadeRun* made : chosen) {
    table.rows.push_back(
        figures.row({made->run.law, x.values[made->x], y.values[made->y]}, made->run));
  }
  return table;
}

Table margin_table(const LabPlan& plan, const std::vector<MadeRun>& runs) {
  Table table{{{"scenario"}, {"law"}, {"gain_limit_per_s", 3}, {"delay_limit_frames"}}, {}};
  const auto scenario = [&](const MadeRun& made) { return plan.margins[made.of].scenario; };
  add_pairs(table, of_part(runs, LabPart::Margin), scenario);
  return table;
}

Table order_table(const LabPlan& plan, const std::vector<MadeRun>& runs) {
  Table table{{{"scenario"}, {"law"}, {"slope_to_screw", 3}, {"slope_to_straight_line", 3}}, {}};
  const auto scenario = [&](const MadeRun& made) { return plan.orders[made.of].scenario; };
  add_pairs(table, of_part(runs, LabPart::Order), scenario);
  return table;
}

}  // namespace kestrel
