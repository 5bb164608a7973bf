#pragma once

#include <string>
#include <vector>

#include "kestrel/calibration/view_collector.hpp"

#include "calibrate.hpp"

namespace kestrel::app {

/// How a live camera is opened, and whoever holds the board before it told.
struct LiveCapture {
  Guide guide = Guide::Lines;
  CaptureSettings capture;
};

/// Looks for the board in pictures (files, folders, printf patterns: every one counts) or in the
/// frames of a video or live camera (those that view_advice takes; a live camera until it has
/// enough, Ctrl-C, or a right click in the window), and says on stderr what came of each. Throws
/// std::runtime_error for an input that is not there and for a window without a display,
/// std::invalid_argument for a board that does not check, and for capture settings of what is no
/// live camera.
ViewCollector collect_views(const std::vector<std::string>& inputs, const Board& board,
                            const GuideOptions& options, const LiveCapture& live);

}  // namespace kestrel::app
