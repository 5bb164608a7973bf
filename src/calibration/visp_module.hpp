#pragma once

#include <optional>
#include <vector>

#include "kestrel/geometry/camera.hpp"
#include "kestrel/geometry/transform.hpp"

namespace kestrel {

/// A point on the board, m, and where it is seen.
struct VispPoint {
  double x_m = 0;
  double y_m = 0;
  Pixel seen;
};

/// Where the vehicle was, and the target in its camera.
struct VispStation {
  Transform<frame::World, frame::Body> world_from_body;
  TargetPose camera_from_target;
};

/// What kestrel_visp_calibration.so gives: ViSP's calibration, behind which stand hundreds of
/// libraries.
struct VispModule {
  /// The camera of lens Pinhole or VispRadial by ViSP's virtual visual servoing over all views,
  /// begun at `start`; empty when ViSP gives up.
  std::optional<CameraParameters> (*calibrate)(const std::vector<std::vector<VispPoint>>& views,
                                               const CameraParameters& start, Lens lens);
  /// The mount by vpHandEyeCalibration; empty when ViSP gives up.
  std::optional<Mount> (*hand_eye)(const std::vector<VispStation>& stations);
};

}  // namespace kestrel
