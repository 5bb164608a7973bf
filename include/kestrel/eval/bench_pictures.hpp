#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kestrel/eval/bench_run.hpp"
#include "kestrel/io/report.hpp"

namespace kestrel {

/// The frames a human should look at, worst first, at most `count`: labelled frames that are not
/// found or more than `worth_px` off; a frame that is found and wrong is worse than one not found.
/// Each stands for its neighbourhood: no two are nearer than a twentieth of the labelled frames.
std::vector<std::int64_t> worst_frames(const std::vector<FrameScore>& scores, int count,
                                       double worth_px);

/// Pictures of the worst frames of each run of one sequence, in the order of the runs: the outline
/// that was reported in white, the true corners in red, the window in black. The sequence is
/// decoded once. A run whose frames can no longer be read has none.
std::vector<std::vector<ReportPicture>> worst_pictures(const BenchSequence& sequence,
                                                       const std::vector<BenchRun>& runs,
                                                       int count);

}  // namespace kestrel
