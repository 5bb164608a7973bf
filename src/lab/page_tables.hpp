#pragma once

#include <string>

#include "kestrel/lab/lab_report.hpp"

/// The tables of the page, as HTML.
namespace kestrel {

/// Laws down, scenarios across, without modifiers; then a table for each scenario that has
/// modified runs: laws down, modifiers across. A cell says the outcome and leads to its plots.
std::string outcome_tables(const LabReport& report);

std::string margin_table(const std::vector<LabMargin>& margins);

/// Cards: formula, needs, source, use, what breaks it.
std::string law_sheets(const std::vector<LabSheet>& sheets);

}  // namespace kestrel
