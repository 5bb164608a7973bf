#include "kestrel/vision/paper_track.hpp"

#include <cmath>
#include <utility>

#include "kestrel/vision/corner_covariance.hpp"
#include "kestrel/vision/outline_deviation.hpp"
#include "kestrel/vision/window.hpp"

#include "search/parted.hpp"

namespace kestrel {
namespace {

/// Four pairs determine a homography: with fewer keypoints there is nothing to look for.
constexpr std::size_t kFewestKeypoints = 4;

/// A window of less than this holds no keypoint: looking there would be a frame thrown away.
constexpr double kMinSidePx = 16;

/// Of a keypoint's coordinate: a few pairs can agree better by chance, px.
constexpr double kLeastNoisePx = 0.5;

/// The part of the window that lies in the image; the whole image when too little does (another
/// camera mode, a window that is not finite).
PixelBox usable(const PixelBox& window, int image_width, int image_height) {
  const bool is_finite = std::isfinite(window.u) && std::isfinite(window.v) &&
                         std::isfinite(window.width) && std::isfinite(window.height);
  const PixelBox part = is_finite ? clipped(window, image_width, image_height) : PixelBox{};
  const bool is_enough = part.width >= kMinSidePx && part.height >= kMinSidePx;
  return is_enough ? part : PixelBox{0, 0, double(image_width), double(image_height)};
}

/// Another stream of chance for each frame: what one frame's draws missed the next one's may find.
RansacOptions for_frame(RansacOptions options, std::int64_t index) {
  options.seed ^= (std::uint64_t(index) + 1) * 0xD1342543DE82EF95ull;  // odd: one to one
  return options;
}

/// Why the answer of RANSAC is not to be believed; None when it is.
Miss doubt(const Template& model, const Homography& H, const std::vector<PixelPair>& inliers,
           const TrackOptions& options) {
  if (!is_plausible(H, model.width(), model.height(), options.outline)) return Miss::BadOutline;
  const double deviation = outline_deviation_px(H, inliers, model.width(), model.height());
  return deviation <= options.max_outline_deviation_px ? Miss::None : Miss::Undetermined;
}

/// The search of one window: fills in everything but where to look next.
Track look(const Template& model, const Frame& frame, const PixelBox& window,
           const TrackOptions& options) {
  Track result;
  result.window = window;
  const Keypoints seen = detect_keypoints(frame.gray, window, options.sift);
  result.keypoints = int(seen.at.size());
  result.miss = Miss::FewKeypoints;
  if (seen.at.size() < kFewestKeypoints) return result;
  const std::vector<PixelPair> pairs =
      distinct_pairs(model.matcher().match(seen.descriptors), model.keypoints(), seen);
  result.matches = int(pairs.size());
  result.miss = Miss::FewMatches;
  if (result.matches < consensus(pairs.size(), options.ransac)) {
    result.others = pairs;
    return result;
  }
  const auto fit = ransac_homography(pairs, for_frame(options.ransac, frame.index));
  result.trials = fit ? fit->trials : options.ransac.max_trials;
  result.miss = Miss::NoConsensus;
  PartedPairs matched = parted(pairs, fit ? fit->inliers : std::vector<int>{});
  result.inliers = std::move(matched.inliers);
  result.others = std::move(matched.others);
  if (!fit) return result;
  result.miss = doubt(model, fit->image_from_template, result.inliers, options);
  if (result.miss != Miss::None) return result;
  result.image_from_template = fit->image_from_template;
  result.status = TrackStatus::Found;
  result.stage = TrackStage::Detected;
  result.confidence = double(result.inliers.size()) / result.matches;
  result.corner_covariance = corner_covariance(fit->image_from_template, result.inliers,
                                               model.width(), model.height(), kLeastNoisePx);
  return result;
}

}  // namespace

Track paper_track(const Template& model, const Frame& frame, const TrackState& state,
                  const TrackOptions& options) {
  if (!has_image(frame)) {  // nothing was looked at, so the next frame looks where this one should
    Track blind;
    blind.miss = Miss::NoImage;
    blind.next = state;
    return blind;
  }
  const int width = frame.gray.cols;
  const int height = frame.gray.rows;
  Track result = look(model, frame, usable(state.window, width, height), options);
  if (result.found()) {
    const auto corners = outline(*result.image_from_template, model.width(), model.height());
    result.next.window = window_around(corners, width, height);
  } else {
    result.next.window = doubled_window(result.window, width, height);
  }
  return result;
}

}  // namespace kestrel
