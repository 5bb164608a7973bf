#pragma once

#include <optional>
#include <vector>

#include "kestrel/calibration/camera_solver.hpp"

namespace kestrel {

/// How well cameras explain pictures that they were not calibrated from.
struct HoldOut {
  int folds = 0;
  double rms_px = 0;  // root mean square distance of all points, each view under the camera of the
                      // other folds, its pose alone fitted to it
};

/// Cross-validation (Stone 1974): view i belongs to fold i modulo `folds`; each fold is left out
/// once. Empty when less than four views would remain or a fold has no solution. A value well above
/// the calibration's own rms says that the model has more freedom than the views can settle.
std::optional<HoldOut> hold_out(const std::vector<BoardView>& views, const Board& board,
                                ImageSize size, CameraModel model, int folds = 5);

}  // namespace kestrel
