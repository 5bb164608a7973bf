#include "kestrel/sim/shutter.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "kestrel/geometry/rotation.hpp"

namespace kestrel {
namespace {

/// Motion is measured over stretches no longer than this: a fifth of the period of a rotor's second
/// harmonic, 2 x 24 Hz.
constexpr double kStretch_s = 0.004;
constexpr double kMostStretches = 16;

/// Fastest motion in the picture while any row is exposed, px/s.
double fastest_px_s(const CameraInFlight& motion, double stamp_s, const Renderer& renderer,
                    const ShutterOptions& options) {
  const double open_s = options.exposure_s + options.readout_s;
  if (open_s == 0) return 0;
  const double count = std::clamp(std::ceil(open_s / kStretch_s), 2.0, kMostStretches);
  double farthest_px = 0;
  CameraAt before = camera_at(motion, stamp_s, stamp_s - open_s / 2);
  for (int i = 1; i <= int(count); ++i) {
    const CameraAt after = camera_at(motion, stamp_s, stamp_s + open_s * (i / count - 0.5));
    farthest_px = std::max(farthest_px, renderer.motion_px(before, after));
    before = after;
  }
  return farthest_px * count / open_s;
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

Shot shot(const CameraInFlight& motion, double stamp_s, const Renderer& renderer,
          const ShutterOptions& options) {
  const double speed_px_s = fastest_px_s(motion, stamp_s, renderer, options);
  const int rows = renderer.size().height;
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
