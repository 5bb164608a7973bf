#pragma once

#include <array>
#include <optional>
#include <string>

#include <opencv2/core/mat.hpp>

#include "kestrel/vehicle/failsafe.hpp"
#include "kestrel/vision/frame.hpp"
#include "kestrel/vision/template.hpp"
#include "kestrel/vision/track.hpp"

namespace kestrel {

/// What is drawn besides what was seen.
struct OverlayOptions {
  int max_lines = 40;                                // of the matches that are joined
  std::optional<std::array<Pixel, 4>> goal_corners;  // where the corners are wanted, px
  std::optional<FailsafeCommand> sent;               // what was commanded, and on what ground
};

/// The frame as the paper's figure 4 shows it, 8-bit BGR, as wide as the frame and a status line
/// higher: the template in the upper-left corner (unscaled, or fitted into a quarter of the frame),
/// inlier matches joined to it by lines of different colours, the projected outline in white (in
/// grey where it is only predicted), the processed window in black with a light edge; current
/// corners in green and, with a goal, desired ones in red. A template keypoint keeps its colour
/// from frame to frame, and of many matches the same ones are drawn again. The status line says
/// frame, state, inliers of matches and command, or LOST and why. Parts that are not finite or
/// outside are left out; a frame that is empty or not 8-bit grey gives a grey field.
/// template_picture: 8-bit grey, may be empty.
cv::Mat overlay(const Frame& frame, const cv::Mat& template_picture, const Track& track,
                const OverlayOptions& options = {});

/// The same for the template's own picture.
inline cv::Mat overlay(const Frame& frame, const Template& model, const Track& track,
                       const OverlayOptions& options = {}) {
  return overlay(frame, model.picture(), track, options);
}

/// The words of the status line.
std::string status_line(const Frame& frame, const Track& track,
                        const std::optional<FailsafeCommand>& sent);

}  // namespace kestrel
