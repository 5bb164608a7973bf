#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "kestrel/lab/lab_plan.hpp"
#include "kestrel/lab/lab_table.hpp"

#include "compare.hpp"

namespace kestrel::app {

/// "configuration.yaml": the effective plan in a run folder.
extern const char* const kPlanFile;

/// Makes the folder of a comparison, or takes one that is there, and writes the plan's text and
/// starts to it. Returns the plan as it reads back. Throws std::runtime_error with path, cause and
/// remedy, also when the folder is that of something else.
LabPlan claim_folder(const std::filesystem::path& folder, const LabPlan& plan,
                     const std::string& text);

/// Writes what the runs came to: results.csv, results.json, table.txt and, where the plan has them,
/// basins.csv, basin_runs.csv, maps/NAME.csv, margins.csv. Throws as claim_folder.
void write_results(const std::filesystem::path& folder, const LabPlan& plan,
                   const std::vector<MadeRun>& runs);

/// Prints the tables, or the JSON, on standard output.
void print_results(const LabPlan& plan, const std::vector<MadeRun>& runs, Printed printed);

}  // namespace kestrel::app
