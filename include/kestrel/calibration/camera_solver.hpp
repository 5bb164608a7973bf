#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "kestrel/calibration/board.hpp"
#include "kestrel/calibration/camera_model.hpp"
#include "kestrel/geometry/camera.hpp"
#include "kestrel/geometry/transform.hpp"
#include "kestrel/io/camera_file.hpp"

namespace kestrel {

/// Views that no camera can be found from; says why and what to do.
class CalibrationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A number that was found, and how well it is known.
struct ParameterEstimate {
  std::string name;  // fx, fy, cx, cy, k1, ...
  double value = 0;
  double deviation = 0;  // standard deviation, same unit
  std::string unit;      // "px" or none
};

/// Where a point of the board was seen, and how far from there the camera found puts it.
struct PointResidual {
  Pixel seen;
  double du_px = 0;  // put less seen
  double dv_px = 0;
};

/// A view as the camera found explains it.
struct SolvedView {
  std::string name;
  TargetPose camera_from_board;  // board_points' frame in the camera, m
  std::vector<PointResidual> residuals;
  double rms_px = 0;    // root mean square distance of its points
  double worst_px = 0;  // largest distance
};

/// A calibrated camera and what speaks for it.
struct Calibration {
  CameraModel model = CameraModel::None;
  CameraParameters camera;
  std::vector<ParameterEstimate> parameters;
  std::vector<SolvedView> views;
  double rms_px = 0;    // root mean square distance of all points, as OpenCV gives it
  double noise_px = 0;  // standard deviation of one coordinate, by the residuals
};

/// The camera of this model that puts the points of the board nearest to where they were seen: the
/// least squares over camera and poses together. Found by OpenCV (cv::calibrateCamera, Zhang 2000;
/// cv::fisheye::calibrate), finished by Levenberg and Marquardt's method in double precision with
/// the poses eliminated (Triggs et al. 2000, section 6), whose normal equations also give the
/// standard deviations: noise_px^2 times the inverse, the noise from residuals over degrees of
/// freedom. Throws CalibrationError for fewer than three views, a view of fewer than four points,
/// points that are not finite, outside the image or not of the board, and for views that have no
/// solution (a board never tilted, nonsense).
Calibration solve_camera(const std::vector<BoardView>& views, const Board& board, ImageSize size,
                         CameraModel model);

/// The view as this camera explains it: the pose in the least squares of the pixels. Its residuals
/// are empty when there is no pose.
SolvedView solve_view(const BoardView& view, const Board& board, const Camera& camera);

}  // namespace kestrel
