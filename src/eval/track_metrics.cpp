#include "kestrel/eval/track_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kestrel {
namespace {

double mean_distance(const Homography& frame_from_first, const Corners& first,
                     const Corners& labelled) {
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) sum += distance(frame_from_first * first[i], labelled[i]);
  return std::isfinite(sum) ? sum / 4 : std::numeric_limits<double>::infinity();
}

/// Errors of the found frames, smallest first.
std::vector<double> sorted_errors(const std::vector<FrameScore>& scores) {
  std::vector<double> errors;
  for (const FrameScore& score : scores) {
    if (score.error_px) errors.push_back(*score.error_px);
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

double median(const std::vector<double>& sorted) {
  const std::size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
}

/// The smallest value that at least `percent` of a hundred do not exceed (nearest rank).
double percentile(const std::vector<double>& sorted, std::size_t percent) {
  return sorted[(sorted.size() * percent + 99) / 100 - 1];
}

struct Gaps {
  int longest = 0;
  int recoveries = 0;
};

Gaps gaps(const std::vector<FrameScore>& scores) {
  Gaps result;
  int lost_in_a_row = 0;
  bool lost = false;
  for (const FrameScore& score : scores) {
    if (!score.error_px) {
      lost = true;
      result.longest = std::max(result.longest, ++lost_in_a_row);
      continue;
    }
    lost_in_a_row = 0;
    if (*score.error_px > kWrongPx) continue;
    if (lost) ++result.recoveries;
    lost = false;
  }
  return result;
}

}  // namespace

std::vector<FrameScore> frame_scores(const TrackTruth& truth, const TrackEstimate& estimate) {
  std::vector<FrameScore> scores;
  for (const auto& [frame, labelled] : truth) {
    FrameScore score{frame, std::nullopt};
    const auto answer = estimate.find(frame);
    if (answer != estimate.end() && answer->second) {
      score.error_px = mean_distance(*answer->second, truth.begin()->second, labelled);
    }
    scores.push_back(score);
  }
  return scores;
}

TrackMetrics track_metrics(const TrackTruth& truth, const TrackEstimate& estimate) {
  const std::vector<FrameScore> scores = frame_scores(truth, estimate);
  const std::vector<double> errors = sorted_errors(scores);
  const auto share_within = [&](double limit_px) {
    const auto end = std::upper_bound(errors.begin(), errors.end(), limit_px);
    return scores.empty() ? 0.0 : double(end - errors.begin()) / double(scores.size());
  };
  TrackMetrics m;
  m.labelled = int(scores.size());
  m.found = int(errors.size());
  m.within_1px = share_within(1);
  m.within_2px = share_within(2);
  m.within_3px = share_within(3);
  m.within_5px = share_within(5);
  m.within_10px = share_within(10);
  m.wrong = int(std::count_if(errors.begin(), errors.end(), [](double e) { return e > kWrongPx; }));
  if (!errors.empty()) {
    m.median_px = median(errors);
    m.p95_px = percentile(errors, 95);
    m.max_px = errors.back();
  }
  const Gaps g = gaps(scores);
  m.longest_gap = g.longest;
  m.recoveries = g.recoveries;
  for (const auto& [frame, answer] : estimate) {
    if (answer && truth.count(frame) == 0) ++m.found_unlabelled;
  }
  return m;
}

}  // namespace kestrel
