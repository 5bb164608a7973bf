#include "compare_folder.hpp"

#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "kestrel/io/csv.hpp"
#include "kestrel/lab/lab_page.hpp"
#include "kestrel/lab/lab_plan_file.hpp"
#include "kestrel/lab/plan_report.hpp"
#include "kestrel/servo/law_catalogue.hpp"

namespace kestrel::app {
namespace {

namespace fs = std::filesystem;

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw std::runtime_error(folder.string() + ": cannot create the folder: " + error.message() +
                             "; choose one that can be written with --output");
  }
}

/// The tables as a reader wants them.
std::string tables_text(const LabPlan& plan, const std::vector<MadeRun>& runs) {
  std::string text;
  const auto add = [&](const std::string& table) { text += (text.empty() ? "" : "\n") + table; };
  for (const ReportTable& table : outcome_tables(runs)) add(aligned(table));
  if (!plan.basins.empty()) add(aligned(readable(basin_table(plan, runs))));
  if (!plan.margins.empty()) add(aligned(readable(margin_table(plan, runs))));
  if (!plan.orders.empty()) add(aligned(readable(order_table(plan, runs))));
  return text;
}

std::string results_json(const LabPlan& plan, const std::vector<MadeRun>& runs) {
  const std::string title =
      nlohmann::json(plan.title).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  std::string text = "{\n\"title\": " + title + ",\n\"runs\": " + json(results_table(runs), 1);
  if (!plan.basins.empty()) text += ",\n\"basins\": " + json(basin_table(plan, runs), 1);
  for (std::size_t i = 0; i < plan.maps.size(); ++i) {
    text += i == 0 ? ",\n\"maps\": {\n" : ",\n";
    text += "\"" + plan.maps[i].name + "\": " + json(map_table(plan, i, runs), 1);
  }
  if (!plan.maps.empty()) text += "\n}";
  if (!plan.margins.empty()) text += ",\n\"margins\": " + json(margin_table(plan, runs), 1);
  if (!plan.orders.empty()) text += ",\n\"orders\": " + json(order_table(plan, runs), 1);
  return text + "\n}\n";
}

std::string page(const LabPlan& plan, const std::vector<MadeRun>& runs) {
  LabReport report = report_of(plan, runs);
  report.what = "Image-based and pose-based control laws, each on the same runs.";
  report.commands = std::string("kestrel compare ") + kPlanFile;
  report.configuration = plan_text(plan);
  for (const Law law : all_laws()) {
    const LawSheet& sheet = law_sheet(law);
    report.sheets.push_back(
        {name(law), sheet.formula, sheet.needs, sheet.source, sheet.use, sheet.breaks});
  }
  return lab_page(report);
}

}  // namespace

const char* const kPlanFile = "configuration.yaml";

LabPlan claim_folder(const fs::path& folder, const LabPlan& plan, const std::string& text) {
  std::error_code error;
  const bool is_strange = fs::is_directory(folder, error) && !fs::is_empty(folder, error) &&
                          !fs::exists(folder / kPlanFile, error);
  if (is_strange) {
    throw std::runtime_error(folder.string() +
                             ": is the folder of something else; choose another with --output");
  }
  make_folder(folder);
  for (const PlannedBasin& basin : plan.basins) {
    const fs::path file = folder / starts_file(basin);
    make_folder(file.parent_path());
    write_text(file, starts_csv(basin.starts));
  }
  write_text(folder / kPlanFile, text);
  return load_plan(folder / kPlanFile);
}

void write_results(const fs::path& folder, const LabPlan& plan, const std::vector<MadeRun>& runs) {
  write_text(folder / "results.csv", csv(results_table(runs)));
  write_text(folder / "results.json", results_json(plan, runs));
  write_text(folder / "index.html", page(plan, runs));
  write_text(folder / "table.txt", tables_text(plan, runs));
  if (!plan.basins.empty()) {
    write_text(folder / "basins.csv", csv(basin_table(plan, runs)));
    write_text(folder / "basin_runs.csv", csv(basin_run_table(plan, runs)));
  }
  if (!plan.maps.empty()) make_folder(folder / "maps");
  for (std::size_t i = 0; i < plan.maps.size(); ++i) {
    write_text(folder / "maps" / (plan.maps[i].name + ".csv"), csv(map_table(plan, i, runs)));
  }
  if (!plan.margins.empty()) write_text(folder / "margins.csv", csv(margin_table(plan, runs)));
  if (!plan.orders.empty()) write_text(folder / "orders.csv", csv(order_table(plan, runs)));
}

void print_results(const LabPlan& plan, const std::vector<MadeRun>& runs, Printed printed) {
  fmt::print("{}", printed == Printed::Json ? results_json(plan, runs) : tables_text(plan, runs));
}

}  // namespace kestrel::app
