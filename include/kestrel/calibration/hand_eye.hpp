#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "kestrel/calibration/calibration_verdict.hpp"
#include "kestrel/calibration/hand_eye_stations.hpp"
#include "kestrel/geometry/transform.hpp"

namespace kestrel {

/// From where on a hand-eye calibration is doubted, and refused.
struct HandEyeOptions {
  int fewest_stations = 6;            // fewer: refused
  int enough_stations = 12;           // fewer: doubted
  double smallest_spread_rad = 0.05;  // 3 degrees, root mean square about the second axis: refused
  double residual_refused_rad = 0.1;  // 6 degrees: attitudes and pictures do not belong together
  double deviation_doubted_rad = 0.01;  // 0.6 degrees
  double deviation_doubted_m = 0.05;

  /// Throws std::invalid_argument that names the first option out of its range.
  void check() const;
};

/// A mount that was measured, and how well it is known. Without an answer (too few stations,
/// rotation about one axis only) there are objections and nothing else.
struct HandEyeResult {
  std::optional<Mount>
      body_from_camera;  // translation zero unless translation_deviation_m is there
  Eigen::Vector3d rotation_deviation_rad = Eigen::Vector3d::Zero();  // about the camera's x, y, z
  /// Standard deviations along forward, right, down; empty when the positions are not known.
  std::optional<Eigen::Vector3d> translation_deviation_m;
  /// How far each station's target is turned, in the world, from the mean of all, rad.
  std::vector<double> residuals_rad;
  double residual_rad = 0;           // root mean square of those
  std::optional<double> residual_m;  // the same of its place, where positions are known
  Eigen::Vector3d spread_rad = Eigen::Vector3d::Zero();  // of the attitudes, rms, largest first
  std::vector<Objection> objections;                     // refusals first
};

/// How the camera is mounted, from stations at which the vehicle's attitude (and position) and the
/// pose of a target that stands still are known: A X = X B by ViSP's vpHandEyeCalibration (Tsai and
/// Lenz 1989, then virtual visual servoing), in the module kestrel_visp_calibration.so, which is
/// loaded here. The translation is estimated when every station has a position.
///
/// Standard deviations are the jackknife's: the stations, in their order, are dealt into ten groups
/// of neighbours (fewer than ten: one each), each group is left out once, sqrt((g - 1) / g sum
/// (x_i - mean)^2) (Efron and Stein 1981; groups: Kunsch 1989). So they know of errors that are
/// alike in neighbours, as in flight, but not of a compass that is off everywhere.
///
/// Throws std::invalid_argument for options that do not check, std::runtime_error when the module
/// cannot be loaded.
HandEyeResult hand_eye(const std::vector<HandEyeStation>& stations,
                       const HandEyeOptions& options = {});

/// What hand_eye found, for people: the mount in words, angles, deviations, residuals, objections.
std::string hand_eye_text(const HandEyeResult& result);

/// The mount file of a result that is not refused: its comment says where it comes from and how
/// well it is known. translation_m: in place of a translation that was not estimated.
std::string hand_eye_mount(const HandEyeResult& result, const Eigen::Vector3d& translation_m);

}  // namespace kestrel
