#pragma once

#include <Eigen/Core>

namespace kestrel {

/// How the engine and the rotor shake the camera: small turns about its mount at the rotor's
/// frequency and twice that, as a two-bladed rotor does.
struct VibrationOptions {
  Eigen::Vector3d amplitude_rad =
      Eigen::Vector3d::Zero();  // roll, pitch, yaw, of the first harmonic
  double frequency_hz = 23.9;   // of the rotor: 150 rad/s
  double second_share = 0.5;    // amplitude of the second harmonic

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// Rotation vector (rad, Body) by which the camera's mount is turned at this instant. A sine of
/// each harmonic; the three axes are a third of a turn apart, so that they do not shake as one.
Eigen::Vector3d vibration(const VibrationOptions& options, double time_s);

}  // namespace kestrel
