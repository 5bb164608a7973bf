#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "kestrel/eval/track_metrics.hpp"
#include "kestrel/geometry/homography.hpp"
#include "kestrel/geometry/pixel.hpp"
#include "kestrel/vision/frame.hpp"

namespace kestrel {

/// What a tracker says of one frame.
struct BenchAnswer {
  std::optional<Homography> image_from_template;  // px of the rectangle -> px of the frame
  PixelBox window;                                // where it looked, px
  int keypoints = 0;
  int matches = 0;
  int inliers = 0;
  std::string state;  // one word: found, lost, ...
};

/// Follows a template through the frames of one sequence, in order.
using BenchTracker = std::function<BenchAnswer(const Frame&)>;

/// A way to track: learns the rectangle of an 8-bit grey image. Throws std::invalid_argument when
/// it refuses the template.
struct BenchMethod {
  std::string name;
  std::function<BenchTracker(const cv::Mat& gray, const PixelBox& box)> learn;
};

/// A recorded or rendered sequence with its labels. open() may be called several times, also from
/// several threads.
struct BenchSequence {
  std::string name;
  std::function<std::unique_ptr<FrameSource>()> open;
  PixelBox template_px;
  TrackTruth truth;  // empty: not labelled
};

}  // namespace kestrel
