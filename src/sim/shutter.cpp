#include "kestrel/sim/shutter.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "kestrel/geometry/rotation.hpp"

namespace kestrel {
namespace {

constexpr double kNear_m = 3;

/// Fastest motion in the picture, px/s, but for what turns about the optical axis does far out.
double fastest_px_s(const CameraInFlight& motion, const Camera& camera) {
  const VibrationOptions& v = motion.vibration;
  const double shaking_rad_s =
      v.amplitude_rad.norm() * 2 * M_PI * v.frequency_hz * (1 + 2 * v.second_share);
  const double turning_rad_s = motion.vehicle.rate_rad_s.norm() + shaking_rad_s;
  return camera.parameters().px * (turning_rad_s + motion.vehicle.velocity_m_s.norm() / kNear_m);
}

int steps(double motion_px, const ShutterOptions& options) {
  return int(std::clamp(std::ceil(motion_px / options.step_px), 1.0, double(options.max_steps)));
}

}  // namespace

void ShutterOptions::check() const {
  const auto require = [](bool good, const char* what) {
    if (!good) throw std::invalid_argument(what);
  };
  require(exposure_s >= 0 && exposure_s <= 1, "exposure_s: must be within [0, 1]");
  require(readout_s >= 0 && readout_s <= 1, "readout_s: must be within [0, 1]");
  require(step_px > 0 && std::isfinite(step_px), "step_px: must be positive");
  require(max_steps >= 1 && max_steps <= 1000, "max_steps: must be within [1, 1000]");
}

CameraAt camera_at(const CameraInFlight& motion, double stamp_s, double time_s) {
  const double ahead_s = time_s - stamp_s;
  Transform<frame::World, frame::Body> body = motion.vehicle.world_from_body;
  body.translation += motion.vehicle.velocity_m_s * ahead_s;
  body.rotation = body.rotation * rotation_from_vector(motion.vehicle.rate_rad_s * ahead_s) *
                  rotation_from_vector(vibration(motion.vibration, time_s));
  return {time_s, body * motion.body_from_camera};
}

Shot shot(const CameraInFlight& motion, double stamp_s, const Camera& camera,
          const ShutterOptions& options) {
  const double speed_px_s = fastest_px_s(motion, camera);
  const int rows = camera.parameters().height;
  const int views = steps(speed_px_s * options.exposure_s, options);
  const int bands = std::min(rows, steps(speed_px_s * options.readout_s, options));
  Shot all;
  for (int b = 0; b < bands; ++b) {
    const double band_s = options.readout_s * ((b + 0.5) / bands - 0.5);
    Band band{b * rows / bands, {}};
    for (int i = 0; i < views; ++i) {
      const double view_s = options.exposure_s * ((i + 0.5) / views - 0.5);
      band.during.push_back(camera_at(motion, stamp_s, stamp_s + band_s + view_s));
    }
    all.push_back(std::move(band));
  }
  return all;
}

}  // namespace kestrel
