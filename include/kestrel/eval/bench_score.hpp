#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kestrel/eval/bench_run.hpp"
#include "kestrel/eval/spread.hpp"
#include "kestrel/eval/track_metrics.hpp"

namespace kestrel {

/// The part of the labels a run can be judged by: the rows of the frames it was given. All of them
/// for a run without frames (nothing of what was to be found was found). Empty when the frame the
/// template was learned in has no row: the labels say where their first row's corners went, and
/// that is not where the tracker started.
TrackTruth judged_by(const TrackTruth& truth, const BenchRun& run);

/// What a run reported, as the map of the first frame's image to each frame's.
TrackEstimate estimate_of(const BenchRun& run);

/// A run in numbers.
struct BenchScore {
  std::string sequence;
  std::string method;
  BenchEnd end = BenchEnd::Done;
  std::string reason;
  int frames = 0;
  int found = 0;    // of all frames, labelled or not, right or wrong
  int skipped = 0;  // frames that could not be decoded
  bool is_judged = false;
  TrackMetrics metrics;  // all zero when it is not judged

  /// Means over all frames, 0 for no frames.
  double window_width_px = 0;
  double window_height_px = 0;
  double keypoints = 0;
  double matches = 0;
  double inliers = 0;

  double learn_s = 0;
  std::optional<Spread> time_s;  // over the frames

  /// Share of the frames with a correct projection: within 5 px of the labels, or, where there are
  /// none, reported as found.
  double correct() const;
};

/// The score of a run against all labels of its sequence (empty: none).
BenchScore bench_score(const BenchRun& run, const TrackTruth& truth);

/// A method over several sequences: each sequence counts alike, however long it is.
struct MethodScore {
  std::string method;
  int sequences = 0;  // that went through or were refused
  int refused = 0;    // counted as nothing found
  int failed = 0;     // left out
  int judged = 0;     // sequences with labels: those the shares are the mean of
  int labelled = 0;   // sum over the sequences, as are the next three
  int wrong = 0;
  int far_wrong = 0;
  int found_unlabelled = 0;
  double coverage = 0;
  double within_1px = 0;
  double within_2px = 0;
  double within_3px = 0;
  double within_5px = 0;
  double within_10px = 0;
  double area_10px = 0;
  std::optional<double> median_px;  // mean over the sequences with a found labelled frame
  std::optional<Spread> time_s;     // over all frames of all sequences
};

/// The methods in the order they first occur, best area first where they differ. runs[i] is of
/// scores[i].
std::vector<MethodScore> method_scores(const std::vector<BenchScore>& scores,
                                       const std::vector<BenchRun>& runs);

}  // namespace kestrel
