#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "kestrel/geometry/homography.hpp"
#include "kestrel/geometry/straight_view.hpp"
#include "kestrel/vision/agreement.hpp"
#include "kestrel/vision/corner_covariance.hpp"
#include "kestrel/vision/corner_motion.hpp"

namespace kestrel {

/// What is known of the target in a frame.
enum class TrackStatus {
  Found,     // seen in this frame
  Coasting,  // not seen, but seen a short time ago: its place is a prediction
  Lost,      // not seen
};

inline constexpr std::array<TrackStatus, 3> kTrackStatuses{
    TrackStatus::Found, TrackStatus::Coasting, TrackStatus::Lost};

/// Why a frame gave no answer.
enum class Miss {
  None,          // the target was found
  NoImage,       // the frame is empty, or not 8-bit grey
  FewKeypoints,  // too little texture in the window
  FewMatches,    // fewer matches than the consensus asks for
  NoConsensus,   // no homography that enough matches agree with
  BadOutline,    // the homography is no possible view of the template
  Undetermined,  // the inliers leave the outline too uncertain
  NotAlike,      // the pixels at the place found are not the template's
  Ambiguous,     // two places look like the template equally well
};

inline constexpr std::array<Miss, 9> kMisses{
    Miss::None,       Miss::NoImage,      Miss::FewKeypoints, Miss::FewMatches, Miss::NoConsensus,
    Miss::BadOutline, Miss::Undetermined, Miss::NotAlike,     Miss::Ambiguous};

/// What the answer of a frame comes from.
enum class TrackStage {
  None,      // no answer
  Aligned,   // the pixels, followed from the frame before
  Searched,  // the same, after a search of the neighbourhood
  Detected,  // keypoints
};

inline constexpr std::array<TrackStage, 4> kTrackStages{TrackStage::None, TrackStage::Aligned,
                                                        TrackStage::Searched, TrackStage::Detected};

/// What the tracker carries from one frame to the next. Values only, of fixed size.
struct TrackState {
  PixelBox window;                      // where to look for keypoints next
  std::optional<CornerMotion> motion;   // as of the last frame the target was found in
  std::optional<Homography> last_seen;  // image_from_template of that frame
  double last_confidence = 0;           // of that frame
  int weak_frames = 0;                  // weak answers in a row
  std::int64_t sweep = 0;               // parts of the frame searched since the target was lost
};

/// What was seen in one frame.
struct Track {
  TrackStatus status = TrackStatus::Lost;
  TrackStage stage = TrackStage::None;
  std::optional<Homography> image_from_template;  // only when found
  /// The same place in the image of the camera without its lens, when the method looked through it
  /// (TrackOptions::lens); only when found.
  std::optional<Homography> straight_from_template;
  std::optional<Homography> predicted;  // only when coasting
  Miss miss = Miss::None;
  double age_s = 0;  // since the target was found; 0 when found, or never found
  /// 0 to 1. Found: the share of the template's visible blocks that the image shows, times how well
  /// (Paper: the share of the matches that agree). Coasting: the last one, falling to 0. Lost: 0.
  double confidence = 0;
  /// Of the template's corners in the image, px^2; when found or coasting.
  CornerCovariance corner_covariance = CornerCovariance::Zero();
  PlaceAgreement agreement;  // of the pixels, at the best place looked at; not of Paper
  PixelBox window;           // where it looked, px
  int keypoints = 0;         // in the window; 0 when none were looked for
  int matches = 0;
  int trials = 0;
  std::vector<PixelPair> inliers;  // pairs of keypoints that agree; none where none were looked for
  /// The other matches of the frame: that agree with no place, or with one that was refused.
  std::vector<PixelPair> others;
  TrackState next;

  bool found() const { return image_from_template.has_value(); }
};

/// What was found of a template of this size (px) as the camera without its lens would have it: as
/// it was aligned through the lens, else by straight_view's fit. Empty when it was not found, or
/// the fit is empty.
std::optional<StraightView> straight_view(const Track& track, double width_px, double height_px,
                                          const Camera& camera);

/// One word for a log: "found", "coasting", "lost".
const char* name(TrackStatus status);

/// One word for a log: "found", "few_keypoints", ...
const char* name(Miss miss);

/// One word for a log: "none", "aligned", "searched", "detected".
const char* name(TrackStage stage);

}  // namespace kestrel
