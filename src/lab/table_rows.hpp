#pragma once

#include <string>
#include <vector>

#include "kestrel/lab/lab_table.hpp"

namespace kestrel {

/// The place of a name in a list that grows by new ones.
std::size_t place(std::vector<std::string>& names, const std::string& name);

/// The runs of one part of the plan.
std::vector<const MadeRun*> of_part(const std::vector<MadeRun>& runs, LabPart part);

/// How many starts of a basin a law reached the goal from.
struct BasinCount {
  std::size_t basin = 0;
  std::string law;
  int converged = 0;
  int starts = 0;
};

/// By basin and law, in the order of the runs.
std::vector<BasinCount> basin_counts(const std::vector<MadeRun>& runs);

}  // namespace kestrel
