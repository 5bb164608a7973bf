#pragma once

#include <string>

#include "kestrel/eval/bench_run.hpp"

namespace kestrel {

/// The answers of a run as CSV, a row a frame; the error where the frame is labelled.
std::string frames_csv(const BenchRun& run, const TrackTruth& truth);

/// The times of a run as CSV, ms: the row "learn", then a row a frame.
std::string times_csv(const BenchRun& run);

/// Puts the frames of both texts into the run. Throws std::runtime_error for what those functions
/// did not write.
void read_rows(BenchRun& run, const std::string& frames, const std::string& times);

}  // namespace kestrel
