#pragma once

#include <string>
#include <vector>

#include "kestrel/lab/lab_plan.hpp"
#include "kestrel/lab/lab_runner.hpp"

namespace kestrel {

/// What a run of a plan is for.
enum class LabPart { Table, Map, Basin, Margin, Order };

/// A run of a plan and its place in it.
struct PlannedRun {
  LabPart part = LabPart::Table;
  std::size_t of = 0;  // which of the plan's maps, basins, margins or orders
  std::string law;     // label
  std::size_t x = 0;   // of a map: its cell; of a basin: x is the start
  std::size_t y = 0;
  LabJob job;
};

/// All runs of a plan in the order of its tables: by scenario, modifier and law, then the
/// helicopter's, the maps, basins, margins and orders. Ids: "S3_rz90/cur/kz2", "H0/vp4_des/kz2",
/// "map/NAME/LAW/x3_y0", "basin/NAME/LAW/17", "margin/S0_tutorial/LAW/gain" (or delay),
/// "order/S0_tutorial/LAW/screw" (or straight_line). `program` stands for all that the results
/// depend on besides the plan. clock: of processor time, for law_us. Throws as plan.check().
std::vector<PlannedRun> planned_runs(const LabPlan& plan, const std::string& program,
                                     const LabClock& clock = {});

/// Their jobs, in order.
std::vector<LabJob> jobs_of(const std::vector<PlannedRun>& runs);

}  // namespace kestrel
