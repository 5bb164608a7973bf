#include "kestrel/eval/track_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kestrel/eval/spread.hpp"

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

struct Recoveries {
  std::vector<int> frames;
  int open = 0;  // frames of a loss that has not ended
};

Recoveries recoveries(const std::vector<FrameScore>& scores) {
  Recoveries result;
  for (const FrameScore& score : scores) {
    const bool is_right = score.error_px && *score.error_px <= kWrongPx;
    if (!is_right) {
      ++result.open;
    } else if (result.open > 0) {
      result.frames.push_back(result.open);
      result.open = 0;
    }
  }
  return result;
}

double share_within(const std::vector<double>& sorted, double limit_px, std::size_t of) {
  const auto end = std::upper_bound(sorted.begin(), sorted.end(), limit_px);
  return of == 0 ? 0.0 : double(end - sorted.begin()) / double(of);
}

int farther(const std::vector<double>& errors, double limit_px) {
  return int(std::count_if(errors.begin(), errors.end(), [&](double e) { return e > limit_px; }));
}

double area(const std::vector<double>& errors, double to_px, std::size_t of) {
  double sum = 0;
  for (const double error : errors) sum += std::max(0.0, 1 - error / to_px);
  return of == 0 ? 0.0 : sum / double(of);
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

std::vector<double> precision(const std::vector<FrameScore>& scores,
                              const std::vector<double>& limits_px) {
  const std::vector<double> errors = sorted_errors(scores);
  std::vector<double> shares;
  shares.reserve(limits_px.size());
  for (const double limit : limits_px) {
    shares.push_back(share_within(errors, limit, scores.size()));
  }
  return shares;
}

TrackMetrics track_metrics(const TrackTruth& truth, const TrackEstimate& estimate) {
  const std::vector<FrameScore> scores = frame_scores(truth, estimate);
  const std::vector<double> errors = sorted_errors(scores);
  TrackMetrics m;
  m.labelled = int(scores.size());
  m.found = int(errors.size());
  m.within_1px = share_within(errors, 1, scores.size());
  m.within_2px = share_within(errors, 2, scores.size());
  m.within_3px = share_within(errors, 3, scores.size());
  m.within_5px = share_within(errors, 5, scores.size());
  m.within_10px = share_within(errors, 10, scores.size());
  m.area_10px = area(errors, 10, scores.size());
  m.wrong = farther(errors, kWrongPx);
  m.far_wrong = farther(errors, kFarWrongPx);
  if (const auto spread = spread_of(errors)) {
    m.median_px = spread->median;
    m.p95_px = spread->p95;
    m.max_px = spread->max;
  }
  const Gaps g = gaps(scores);
  m.longest_gap = g.longest;
  m.recoveries = g.recoveries;
  Recoveries r = recoveries(scores);
  m.recovery_frames = std::move(r.frames);
  m.ends_lost = r.open > 0;
  for (const auto& [frame, answer] : estimate) {
    if (answer && truth.count(frame) == 0) ++m.found_unlabelled;
  }
  return m;
}

}  // namespace kestrel
