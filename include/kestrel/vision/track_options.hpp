#pragma once

#include <array>
#include <optional>

#include "kestrel/geometry/camera.hpp"
#include "kestrel/geometry/homography.hpp"
#include "kestrel/vision/align.hpp"
#include "kestrel/vision/corner_motion.hpp"
#include "kestrel/vision/feature_match.hpp"
#include "kestrel/vision/keypoints.hpp"
#include "kestrel/vision/match.hpp"
#include "kestrel/vision/robust_homography.hpp"
#include "kestrel/vision/sift.hpp"
#include "kestrel/vision/template_blocks.hpp"
#include "kestrel/vision/vote_homography.hpp"

namespace kestrel {

/// How the target is found in a frame.
enum class TrackMethod {
  Paper,   // figure 2 of the paper: SIFT, kd-tree and RANSAC in every frame
  Detect,  // keypoints in every frame, verified and refined on the pixels
  Hybrid,  // the pixels followed from frame to frame; keypoints at the start, on doubt and on loss
};

/// Where a method looks for keypoints.
enum class WindowPolicy {
  Fixed,     // twice the template, where the target was last seen; it never grows
  Doubling,  // the paper's: twice the outline where the target was last seen, doubled on each miss
  Kalman,    // where the motion leads, as large as its uncertainty; the whole frame once it is lost
};

/// Whose SIFT the methods Detect and Hybrid use in the frames.
enum class SiftSource {
  Kestrel,  // vision/sift
  OpenCv,   // cv::SIFT, as a reference
};

inline constexpr std::array<TrackMethod, 3> kTrackMethods{TrackMethod::Paper, TrackMethod::Detect,
                                                          TrackMethod::Hybrid};
inline constexpr std::array<WindowPolicy, 3> kWindowPolicies{
    WindowPolicy::Fixed, WindowPolicy::Doubling, WindowPolicy::Kalman};
inline constexpr std::array<SiftSource, 2> kSiftSources{SiftSource::Kestrel, SiftSource::OpenCv};
inline constexpr std::array<Simd, 2> kSimds{Simd::Auto, Simd::Baseline};

/// Parameters of a detection from keypoints.
struct DetectOptions {
  SiftSource source = SiftSource::Kestrel;
  FastSiftOptions sift;
  FeatureMatchOptions match;
  VoteOptions fit;
  int max_px_per_frame = 500000;  // pixels that one look at a frame searches; the rest comes next

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// All parameters of the tracker.
struct TrackOptions {
  TrackMethod method = TrackMethod::Hybrid;
  WindowPolicy window = WindowPolicy::Kalman;  // of Detect and Hybrid
  Simd simd = Simd::Auto;                      // of everything

  // Paper.
  SiftOptions sift;
  MatchOptions match;
  RansacOptions ransac;
  double max_outline_deviation_px = 3;  // so that an outline 10 px off is a three-sigma event

  // Detect and Hybrid.
  DetectOptions detect;
  BlockOptions blocks;
  AlignOptions align;
  MotionOptions motion;
  double coast_s = 0.5;     // a target not seen for longer is lost
  double weak_share = 0.5;  // of the blocks alike; below it the answer is weak
  int weak_frames = 5;      // weak answers in a row after which keypoints are asked

  OutlineOptions outline;

  /// The camera, where the frames are seen through a lens; not of Paper. The template is learned
  /// from a picture without (straight_template).
  std::optional<Camera> lens;

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// One word for a log and a task file: "paper", "detect", "hybrid"; "fixed", ...
const char* name(TrackMethod method);
const char* name(WindowPolicy policy);
const char* name(SiftSource source);  // "kestrel", "opencv"
const char* name(Simd simd);          // "auto", "baseline"

}  // namespace kestrel
