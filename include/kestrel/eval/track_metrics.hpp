#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "kestrel/geometry/homography.hpp"
#include "kestrel/geometry/pixel.hpp"

namespace kestrel {

/// Four labelled points of the target in one frame, px: top left, top right, bottom right, bottom
/// left as the first frame shows it. They need not be the template's corners.
using Corners = std::array<Pixel, 4>;

/// Labels of a sequence by frame number. A frame without a row is not labelled.
using TrackTruth = std::map<std::int64_t, Corners>;

/// What a tracker reported by frame number: the map of the first labelled frame's image to the
/// frame's (frame_from_first), empty where it reported the target as not found.
using TrackEstimate = std::map<std::int64_t, std::optional<Homography>>;

/// A found frame farther off than this is wrong: the tracker reported something else.
inline constexpr double kWrongPx = 10;
/// Farther off than this, it is another place altogether.
inline constexpr double kFarWrongPx = 20;

/// How one labelled frame was answered.
struct FrameScore {
  std::int64_t frame = 0;
  /// Mean distance of the four corners to the frame's row, px: of the first row's corners, mapped
  /// by the homography. Infinite when the homography maps one of them to no finite place; empty
  /// when the target was not found, or the frame not estimated at all.
  std::optional<double> error_px;
};

/// Scores of all labelled frames, in the order of their numbers; the first row's own frame is one
/// of them. Empty for no labels.
std::vector<FrameScore> frame_scores(const TrackTruth& truth, const TrackEstimate& estimate);

/// A sequence in numbers. Shares are of all labelled frames (a frame not found is in none of them),
/// 0 when there are none.
struct TrackMetrics {
  int labelled = 0;  // frames with a row
  int found = 0;     // labelled frames reported as found, right or wrong
  double within_1px = 0;
  double within_2px = 0;
  double within_3px = 0;
  double within_5px = 0;
  double within_10px = 0;
  /// Area under the curve of the share within t for t from 0 to 10 px, over 10 px: 1 when every
  /// error is 0. It is the mean over the labelled frames of max(0, 1 - error / 10 px).
  double area_10px = 0;
  int wrong = 0;      // found, but farther off than kWrongPx or at no finite place
  int far_wrong = 0;  // of these, farther off than kFarWrongPx

  /// Errors over the found labelled frames, wrong ones included, px; empty when there are none. The
  /// median of an even number is the mean of the middle two; the 95 % point is the smallest error
  /// that at least 95 % of them do not exceed.
  std::optional<double> median_px;
  std::optional<double> p95_px;
  std::optional<double> max_px;

  /// Most labelled frames in a row that were not found. Frames without a row neither end nor
  /// lengthen such a gap; a wrong frame ends it.
  int longest_gap = 0;
  /// How often the target was found again, not wrong, after it had not been found.
  int recoveries = 0;
  /// For each time the target was lost (a labelled frame not found, or wrong) and right again
  /// later: how many labelled frames in a row were not right.
  std::vector<int> recovery_frames;
  bool ends_lost = false;  // the last labelled frame was not right
  /// Frames without a row reported as found: neither right nor wrong, the target may be hidden.
  int found_unlabelled = 0;

  /// Share of the labelled frames that were reported as found, right or wrong.
  double coverage() const { return labelled > 0 ? double(found) / labelled : 0; }
};

/// Share of the frames within each of these errors, px: a precision curve. 0 for no frames.
std::vector<double> precision(const std::vector<FrameScore>& scores,
                              const std::vector<double>& limits_px);

/// Metrics of a track against its labels. The first row's frame must be the one the estimate maps
/// from.
TrackMetrics track_metrics(const TrackTruth& truth, const TrackEstimate& estimate);

}  // namespace kestrel
