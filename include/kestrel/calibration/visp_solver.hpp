#pragma once

#include <optional>

#include "kestrel/calibration/camera_solver.hpp"

namespace kestrel {

/// What ViSP's calibration makes of the same views, and ours of the same model beside it.
struct VispCheck {
  CameraParameters visp;   // Pinhole or VispRadial
  double visp_rms_px = 0;  // root mean square distance under visp, as our rms
  /// Our minimum of what ViSP minimises: Pinhole, or VispRadial with both polynomials (parameters
  /// fx, fy, cx, cy, kud, kdu; views empty).
  Calibration ours;
  /// The largest difference of a parameter, in our standard deviations.
  double largest_deviations = 0;
};

/// ViSP's numbers in the order of ours.parameters.
std::vector<double> visp_values(const VispCheck& check);

/// The views through ViSP's vpCalibration (virtual visual servoing, Marchand & Chaumette 2002), of
/// model None for None, else with ViSP's radial distortion, and the same least squares by our
/// solver: with a lens ViSP's is another than ours, of two polynomials that share the rest. It
/// works in the module kestrel_visp_calibration.so, which is loaded here. Empty for a
/// Kannala-Brandt lens, which ViSP does not calibrate, and where ViSP finds no answer. Throws
/// std::runtime_error when the module cannot be loaded, CalibrationError as solve_camera.
std::optional<VispCheck> visp_check(const std::vector<BoardView>& views, const Board& board,
                                    ImageSize size, CameraModel model);

}  // namespace kestrel
