#pragma once

#include <array>

#include <Eigen/Core>

#include "kestrel/geometry/pixel.hpp"

namespace kestrel {

/// Parameters of the Kalman filter over the corners.
struct MotionOptions {
  /// Spectral density of the corners' acceleration as a standard deviation, px/s^2: what a hand or
  /// a helicopter in gusts does to a picture of some 600 px focal length.
  double acceleration_px_s2 = 2000;
  double first_speed_px_s = 600;  // standard deviation of the speed before it has been seen
  double longest_gap_s = 2;       // beyond it a prediction is no longer told from no knowledge

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// One coordinate of one corner: position (px), speed (px/s) and their covariance.
struct CoordinateMotion {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};

/// The outline of the target in motion: a Kalman filter with constant velocity for each coordinate
/// (u0, v0, ..., u3, v3) of its corners. The paper asked for one to centre the window.
struct CornerMotion {
  std::array<CoordinateMotion, 8> coordinates;
  double stamp_s = 0;

  std::array<Pixel, 4> corners() const;
  /// Standard deviation of the least certain coordinate, px.
  double deviation_px() const;
};

/// Motion after the first sight of the corners, whose coordinates have these variances (px^2).
CornerMotion first_motion(const std::array<Pixel, 4>& corners,
                          const Eigen::Matrix<double, 8, 1>& variances, double stamp_s,
                          const MotionOptions& options);

/// The motion carried on to a later time; as it is for an earlier or unknown one.
CornerMotion predicted(CornerMotion motion, double stamp_s, const MotionOptions& options);

/// The motion, predicted to the time of the sight, after the corners were seen with these
/// variances.
CornerMotion corrected(CornerMotion motion, const std::array<Pixel, 4>& corners,
                       const Eigen::Matrix<double, 8, 1>& variances);

/// The smallest box that holds the corners with so many standard deviations to each side.
PixelBox gate(const CornerMotion& motion, double deviations);

}  // namespace kestrel
