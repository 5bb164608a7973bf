#include "kestrel/lab/plan_report.hpp"

#include <algorithm>

#include "kestrel/lab/lab_scene.hpp"

#include "table_rows.hpp"

namespace kestrel {
namespace {

std::vector<LabBasin> basins_of(const LabPlan& plan, const std::vector<MadeRun>& runs) {
  std::vector<LabBasin> basins;
  for (const BasinCount& count : basin_counts(runs)) {
    const Share share = share_of(count.converged, count.starts);
    const std::string where = plan.basins.size() > 1 ? ", " + plan.basins[count.basin].name : "";
    basins.push_back({count.law + where, count.converged, count.starts, share.low, share.high});
  }
  return basins;
}

/// The map of one law, its cells still empty.
LabMap blank(const LabPlan& plan, const PlannedMap& planned, const std::string& law) {
  LabMap map;
  map.title = planned.name + ", " + planned.scenario;
  map.law = law;
  map.x_label = planned.x.key;
  map.y_label = planned.y.key;
  map.x = planned.x.values;
  map.y = planned.y.values;
  map.value_label = "step from which |e| stays below " + std::to_string(plan.rules.error_threshold);
  map.cells.assign(map.y.size(), std::vector<LabMap::Cell>(map.x.size()));
  return map;
}

std::vector<LabMap> maps_of(const LabPlan& plan, const std::vector<MadeRun>& runs) {
  std::vector<LabMap> maps;
  std::vector<std::string> keys;  // of the maps
  for (const MadeRun* made : of_part(runs, LabPart::Map)) {
    const PlannedMap& planned = plan.maps[made->of];
    const std::size_t at = place(keys, planned.name + "/" + made->run.law);
    if (at == maps.size()) maps.push_back(blank(plan, planned, made->run.law));
    LabMap::Cell& cell = maps[at].cells[made->y][made->x];
    cell.end = made->run.end;
    if (cell.end == RunEnd::Converged) cell.value = figure(made->run, "k_error");
  }
  return maps;
}

std::vector<LabMargin> margins_of(const std::vector<MadeRun>& runs) {
  std::vector<LabMargin> margins;
  std::vector<std::string> keys;
  for (const MadeRun* made : of_part(runs, LabPart::Margin)) {
    const LabRun& run = made->run;
    const std::size_t at = place(keys, run.scenario + "/" + run.law);
    if (at == margins.size()) margins.push_back({run.scenario, run.law, {}, {}});
    if (const auto gain = figure(run, "gain_limit_per_s")) margins[at].gain_per_s = gain;
    if (const auto delay = figure(run, "delay_limit_frames")) margins[at].delay_frames = delay;
  }
  return margins;
}

/// Of the slopes towards the screw motion.
std::vector<LabOrder> orders_of(const LabPlan& plan, const std::vector<MadeRun>& runs) {
  std::vector<LabOrder> orders;
  for (const MadeRun* made : of_part(runs, LabPart::Order)) {
    const LabRun& run = made->run;
    if (run.metrics.empty() || run.metrics.front().first != "slope_to_screw") continue;
    const std::string where = plan.orders.size() > 1 ? ", " + plan.orders[made->of].scenario : "";
    orders.push_back({run.law + where, run.metrics.front().second});
  }
  return orders;
}

}  // namespace

LabReport report_of(const LabPlan& plan, const std::vector<MadeRun>& runs) {
  LabReport report;
  report.title = plan.title;
  for (const Scenario& scenario : plan.scenarios) {
    report.scenes.push_back(scene_of(scenario, plan.camera, plan.conditions.limits));
  }
  for (const HelicopterScenario& scenario : plan.helicopter.scenarios) {
    report.scenes.push_back(
        scene_of(scenario, plan.helicopter.camera, plan.helicopter.conditions.limits));
  }
  for (const MadeRun* made : of_part(runs, LabPart::Table)) report.runs.push_back(made->run);
  report.basins = basins_of(plan, runs);
  report.maps = maps_of(plan, runs);
  report.margins = margins_of(runs);
  report.orders = orders_of(plan, runs);
  return report;
}

}  // namespace kestrel
