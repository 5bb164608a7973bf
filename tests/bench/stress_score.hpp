#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "kestrel/eval/bench.hpp"

#include "bench/stress.hpp"

namespace kestrel::test {

/// How one frame was answered and what it cost.
struct ScoredFrame {
  bool is_labelled = false;  // the frame has a row of truth
  bool is_absent = false;    // the frame does not show the target
  bool is_found = false;
  /// Mean distance of the corners to the truth, px; empty when not labelled or not found.
  std::optional<double> error_px;
  double cpu_ms = 0;  // of the process: helpers' threads count
};

/// Runs a method over the frames of a sequence (frames[k] is frame k; the template is learned from
/// the first). Empty when the method refuses the template or breaks.
std::vector<ScoredFrame> scored(const BenchMethod& method, const StressSequence& sequence,
                                const std::vector<cv::Mat>& frames);

/// A line of the table. Shares are of the labelled frames; wrong counts frames more than kWrongPx
/// off and those found where nothing is, and its share is of the labelled and absent ones.
struct ScoreLine {
  int labelled = 0;
  int absent = 0;
  double ok3 = 0;
  double ok5 = 0;
  double wrong = 0;
  std::optional<double> median_px;  // over the found labelled frames, wrong ones included
  std::optional<double> p95_px;
  std::optional<double> median_ms;  // over all frames, the first included
  std::optional<double> p95_ms;
  std::optional<double> max_ms;
};

ScoreLine score_line(const std::vector<ScoredFrame>& frames);

}  // namespace kestrel::test
