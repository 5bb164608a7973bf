#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "kestrel/calibration/camera_solver.hpp"

namespace kestrel {

/// The views solved by what ViSP minimises with its radial lens: each point counts twice, as both
/// polynomials put it, kud where the pinhole's point goes and kdu where the seen one comes from
/// (calibVVSWithDistortionMulti of its vpCalibrationTools.cpp, 3.5; Marchand & Chaumette 2002):
///   u = u0 + px x (1 + kud (x^2 + y^2)),
///   u = u0 + px x - kdu r^2 (u - u0), r^2 = ((u - u0) / px)^2 + ((v - v0) / py)^2.
/// Ours by Levenberg and Marquardt's method, from a camera with k1 alone (start, of CameraModel
/// Radial). Its lens is VispRadial, its parameters fx, fy, cx, cy, kud, kdu; residuals are those of
/// kud; deviations count each point once. Empty when there is no minimum near the start.
std::optional<Calibration> solve_as_visp(const std::vector<BoardView>& views, const Board& board,
                                         const Calibration& start);

}  // namespace kestrel
