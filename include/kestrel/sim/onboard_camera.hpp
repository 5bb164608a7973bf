#pragma once

#include <cstdint>

#include "kestrel/geometry/camera.hpp"
#include "kestrel/geometry/transform.hpp"
#include "kestrel/sim/render.hpp"
#include "kestrel/sim/scene.hpp"
#include "kestrel/sim/shutter.hpp"
#include "kestrel/sim/vehicle.hpp"
#include "kestrel/sim/vibration.hpp"
#include "kestrel/vision/frame.hpp"

namespace kestrel {

/// What the camera and its electronics add.
struct ImagingOptions {
  double noise_grey = 0;  // sensor noise, standard deviation
  double vignetting = 0;  // share of the light missing in the corners
  double gain_drift = 0;  // amplitude of a slow sine of all light, share
  double gain_period_s = 20;
  ShutterOptions shutter;
  VibrationOptions vibration;
  double latency_s = 0;   // from capture until a command decided on the frame is obeyed
  double drop_share = 0;  // frames that never arrive

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// What is aboard, and how it looks.
struct OnboardCameraOptions {
  Camera camera;
  Mount body_from_camera;
  ImagingOptions imaging;
  std::uint64_t seed = 1;  // of noise and drops
};

/// The camera of a helicopter in the computer: pictures of a scene from wherever it is.
class OnboardCamera {
 public:
  /// Throws std::invalid_argument for a scene, a camera or imaging options that do not check.
  OnboardCamera(const Scene& scene, const OnboardCameraOptions& options);

  /// The picture taken at stamp_s, the scene's own time, of a vehicle that moves so; without an
  /// attitude. The same arguments give the same bytes.
  Frame look(const TrueMotion& vehicle, std::int64_t index, double stamp_s) const;

  /// True for a frame that never arrives, by drop_share and the seed; the first always does.
  bool drops(std::int64_t index) const;

 private:
  OnboardCameraOptions options_;
  Renderer renderer_;
};

}  // namespace kestrel
