#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace kestrel {

/// Largest speeds of the camera; a twist beyond them is scaled by one common factor, so that its
/// direction stays (the rule of vpRobot::saturateVelocities).
struct CameraLimits {
  double linear_m_s = 1.0;                    // each axis
  double angular_rad_s = 1.5707963267948966;  // each axis; 90 deg/s
};

/// The modifiers of a run: what the law is told wrongly, late or coarsely.
struct Conditions {
  std::optional<double> gain_per_s{};  // a constant gain in place of the law's own
  double rate_hz = 30;
  int steps = 1500;
  double depth_factor = 1;    // kz: depths and translations told to the law, over the true ones
  double focal_factor = 1;    // kf: focal length believed, over the true one
  double principal_u_px = 0;  // principal point believed, minus the true one
  double principal_v_px = 0;
  /// Whether s* is what the mis-calibrated camera saw at the goal (taught: the error cancels) or is
  /// computed from the goal's pose: then the camera ends where the two look alike, at Z*/kf.
  enum class Desired { Taught, Model } desired = Desired::Taught;
  double noise_px = 0;      // standard deviation of each pixel coordinate
  std::uint64_t seed = 42;  // of the noise
  int delay_frames = 0;     // the command at step k rests on the image of step max(0, k - delay)
  std::optional<CameraLimits> limits{};

  /// Throws std::invalid_argument that names the first one out of range.
  void check() const;
};

/// The conditions changed as a modifier's name says; words joined by "_": kz2 (depth factor), f0.8
/// (focal factor), u20 v20 (principal point, px), model (s* from the goal's pose), d3 (delay,
/// frames), l8 (gain, 1/s), r60 (rate, Hz), n0.5 (noise, px; over 900 steps), sat (the limits
/// above). The empty name changes nothing. Throws std::invalid_argument that names a word it does
/// not know or a value out of range.
Conditions modified(const Conditions& conditions, const std::string& modifier);

}  // namespace kestrel
