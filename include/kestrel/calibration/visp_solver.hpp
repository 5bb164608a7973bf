#pragma once

#include <optional>

#include "kestrel/calibration/camera_solver.hpp"

namespace kestrel {

/// What ViSP's calibration makes of the same views, and ours of the same model beside it.
struct VispCheck {
  CameraParameters visp;   // Pinhole or VispRadial
  double visp_rms_px = 0;  // root mean square distance under visp, as our rms
  Calibration ours;        // of model None or Radial
  /// The largest difference of fx, fy, cx, cy in our standard deviations.
  double largest_deviations = 0;
};

/// The views through ViSP's vpCalibration (virtual visual servoing, Marchand & Chaumette 2002), of
/// model None for None, else with ViSP's radial distortion, compared with Radial of ours. It works
/// in the module kestrel_visp_calibration.so, which is loaded here. Empty for a Kannala-Brandt
/// lens, which ViSP does not calibrate, and where ViSP finds no answer. Throws std::runtime_error
/// when the module cannot be loaded, CalibrationError as solve_camera.
std::optional<VispCheck> visp_check(const std::vector<BoardView>& views, const Board& board,
                                    ImageSize size, CameraModel model);

}  // namespace kestrel
