#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kestrel/lab/lab_table.hpp"

namespace kestrel {

/// The place of a name in a list that grows by new ones.
std::size_t place(std::vector<std::string>& names, const std::string& name);

/// The runs of one part of the plan.
std::vector<const MadeRun*> of_part(const std::vector<MadeRun>& runs, LabPart part);

/// A figure of a run; empty when it has none.
std::optional<double> figure_of(const LabRun& run, const std::string& name);

}  // namespace kestrel
