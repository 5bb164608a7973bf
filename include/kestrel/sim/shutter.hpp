#pragma once

#include "kestrel/geometry/camera.hpp"
#include "kestrel/sim/render.hpp"
#include "kestrel/sim/vehicle.hpp"
#include "kestrel/sim/vibration.hpp"

namespace kestrel {

/// How long a camera looks. The stamp of a frame is the middle of the exposure of its middle row.
struct ShutterOptions {
  double exposure_s = 0;  // of each row
  double readout_s = 0;   // from the first row to the last (rolling shutter); 0: global
  double step_px = 0.5;   // motion between two views that are averaged, or two bands of rows
  int max_steps = 12;     // views averaged, and bands; bounds the time of a frame

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// A vehicle and its camera around the stamp of a frame.
struct CameraInFlight {
  TrueMotion vehicle;  // at the stamp; carried on with its velocity and rates
  Mount body_from_camera;
  VibrationOptions vibration;
};

/// The camera at this time, near the stamp.
CameraAt camera_at(const CameraInFlight& motion, double stamp_s, double time_s);

/// The views a frame with this stamp is made of: one, when nothing moves or the shutter is quick.
/// How many follows from how fast what the camera sees moves in its picture at most, around the
/// stamp: vehicle, vibration and planes.
Shot shot(const CameraInFlight& motion, double stamp_s, const Renderer& renderer,
          const ShutterOptions& options);

}  // namespace kestrel
