#pragma once

#include <string>
#include <vector>

#include "kestrel/eval/bench_score.hpp"

namespace kestrel {

/// One sequence of an evaluation: its runs and their scores, in the same order.
struct SequencePart {
  const BenchSequence* sequence = nullptr;
  std::vector<BenchRun> runs;
  std::vector<BenchScore> scores;
};

/// How many methods the figures show, the first of the list: the palette has as many colours. A
/// method has the same colour in all of them.
inline constexpr std::size_t kMostCurves = 7;

/// SVG pictures: over all sequences, the share of frames within an error (each sequence alike) and
/// the sorted times of the frames; of one sequence, error and time over its frames.
std::string precision_plot(const std::vector<MethodScore>& methods,
                           const std::vector<SequencePart>& parts);
std::string times_plot(const std::vector<MethodScore>& methods,
                       const std::vector<SequencePart>& parts);
std::string error_plot(const SequencePart& part, const std::vector<MethodScore>& methods);
std::string time_plot(const SequencePart& part, const std::vector<MethodScore>& methods);

}  // namespace kestrel
