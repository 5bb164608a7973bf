#pragma once

#include <string>
#include <vector>

#include "kestrel/io/report.hpp"

#include "bench_figures.hpp"

namespace kestrel {

/// The methods over all sequences: table, precision curves, times. Of many methods the plots show
/// the first seven of `methods`.
ReportSection methods_section(const std::vector<MethodScore>& methods,
                              const std::vector<SequencePart>& parts);

/// Table I of the paper and the scores of every run.
ReportSection runs_section(const std::vector<SequencePart>& parts);

/// A sequence: error and time over its frames, and the worst frames of each run.
ReportSection sequence_section(const SequencePart& part, const std::vector<MethodScore>& methods);

}  // namespace kestrel
