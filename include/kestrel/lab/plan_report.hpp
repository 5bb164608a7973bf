#pragma once

#include <string>
#include <vector>

#include "kestrel/lab/lab_report.hpp"
#include "kestrel/lab/lab_table.hpp"

namespace kestrel {

/// What the page shows of a comparison: runs, scenes, basins, maps and margins of those that were
/// made. The laws' sheets and the words about the whole are left to the caller.
LabReport report_of(const LabPlan& plan, const std::vector<MadeRun>& runs);

}  // namespace kestrel
