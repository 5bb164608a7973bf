#include "kestrel/eval/bench_score.hpp"

#include <algorithm>
#include <map>

namespace kestrel {
namespace {

/// Sum over the frames of what one of them gives, over their number.
template <class Value>
double mean(const BenchRun& run, Value value) {
  double sum = 0;
  for (const BenchFrame& frame : run.frames) sum += double(value(frame.answer));
  return run.frames.empty() ? 0.0 : sum / double(run.frames.size());
}

std::vector<double> times(const BenchRun& run) {
  std::vector<double> list;
  list.reserve(run.frames.size());
  for (const BenchFrame& frame : run.frames) list.push_back(frame.time_s);
  return list;
}

/// Sums, of which shares() makes means.
void add(MethodScore& sum, const BenchScore& score) {
  if (score.end == BenchEnd::Failed) {
    ++sum.failed;
    return;
  }
  ++sum.sequences;
  sum.refused += score.end == BenchEnd::Refused ? 1 : 0;
  if (!score.is_judged) return;
  ++sum.judged;
  const TrackMetrics& m = score.metrics;
  sum.labelled += m.labelled;
  sum.wrong += m.wrong;
  sum.far_wrong += m.far_wrong;
  sum.found_unlabelled += m.found_unlabelled;
  sum.coverage += m.coverage();
  sum.within_1px += m.within_1px;
  sum.within_2px += m.within_2px;
  sum.within_3px += m.within_3px;
  sum.within_5px += m.within_5px;
  sum.within_10px += m.within_10px;
  sum.area_10px += m.area_10px;
}

void divide(MethodScore& sum) {
  if (sum.judged == 0) return;
  for (double* share : {&sum.coverage, &sum.within_1px, &sum.within_2px, &sum.within_3px,
                        &sum.within_5px, &sum.within_10px, &sum.area_10px}) {
    *share /= sum.judged;
  }
}

}  // namespace

TrackTruth judged_by(const TrackTruth& truth, const BenchRun& run) {
  if (run.frames.empty()) return truth;
  if (truth.count(run.frames.front().frame) == 0) return {};
  TrackTruth rows;
  for (const BenchFrame& frame : run.frames) {
    const auto row = truth.find(frame.frame);
    if (row != truth.end()) rows.insert(*row);
  }
  return rows;
}

TrackEstimate estimate_of(const BenchRun& run) {
  Eigen::Matrix3d template_from_first = Eigen::Matrix3d::Identity();
  template_from_first(0, 2) = -run.template_px.u;
  template_from_first(1, 2) = -run.template_px.v;
  TrackEstimate estimate;
  for (const BenchFrame& frame : run.frames) {
    std::optional<Homography>& found = estimate[frame.frame];
    if (frame.answer.image_from_template) {
      found = Homography{frame.answer.image_from_template->H * template_from_first};
    }
  }
  return estimate;
}

double BenchScore::correct() const {
  if (is_judged) return metrics.within_5px;
  return frames > 0 ? double(found) / frames : 0;
}

BenchScore bench_score(const BenchRun& run, const TrackTruth& truth) {
  BenchScore score;
  score.sequence = run.sequence;
  score.method = run.method;
  score.end = run.end;
  score.reason = run.reason;
  score.frames = int(run.frames.size());
  score.skipped = int(run.skipped.size());
  for (const BenchFrame& frame : run.frames)
    score.found += frame.answer.image_from_template ? 1 : 0;
  const TrackTruth rows = judged_by(truth, run);
  score.is_judged = !rows.empty() && run.end != BenchEnd::Failed;
  if (score.is_judged) score.metrics = track_metrics(rows, estimate_of(run));
  score.window_width_px = mean(run, [](const BenchAnswer& a) { return a.window.width; });
  score.window_height_px = mean(run, [](const BenchAnswer& a) { return a.window.height; });
  score.keypoints = mean(run, [](const BenchAnswer& a) { return a.keypoints; });
  score.matches = mean(run, [](const BenchAnswer& a) { return a.matches; });
  score.inliers = mean(run, [](const BenchAnswer& a) { return a.inliers; });
  score.learn_s = run.learn_s;
  score.time_s = spread_of(times(run));
  return score;
}

std::vector<MethodScore> method_scores(const std::vector<BenchScore>& scores,
                                       const std::vector<BenchRun>& runs) {
  std::vector<MethodScore> methods;
  std::map<std::string, std::vector<double>> all_times;
  std::map<std::string, std::vector<double>> medians;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    const BenchScore& score = scores[i];
    const auto known = std::find_if(methods.begin(), methods.end(),
                                    [&](const MethodScore& m) { return m.method == score.method; });
    MethodScore& sum = known == methods.end() ? methods.emplace_back() : *known;
    sum.method = score.method;
    add(sum, score);
    const std::vector<double> list = times(runs[i]);
    all_times[score.method].insert(all_times[score.method].end(), list.begin(), list.end());
    if (score.metrics.median_px) medians[score.method].push_back(*score.metrics.median_px);
  }
  for (MethodScore& method : methods) {
    divide(method);
    method.time_s = spread_of(all_times[method.method]);
    if (const auto spread = spread_of(medians[method.method])) method.median_px = spread->mean;
  }
  std::stable_sort(methods.begin(), methods.end(), [](const MethodScore& a, const MethodScore& b) {
    return a.area_10px > b.area_10px;
  });
  return methods;
}

}  // namespace kestrel
