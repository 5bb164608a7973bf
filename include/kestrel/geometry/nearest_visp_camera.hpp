#pragma once

#include "kestrel/geometry/camera.hpp"

namespace kestrel {

/// A camera that ViSP can hold, and how far it is from the one it stands for.
struct NearestVispCamera {
  CameraParameters parameters;
  double largest_px = 0;  // largest distance of the two projections in the image
};

/// The camera among ViSP's models that projects the image most like this one: itself for a
/// pinhole, ViSP's radial model and Kannala-Brandt; for plumb-bob px, py, u0, v0 and kud of ViSP's
/// perspectiveProjWithDistortion in the least squares of the projections of a grid of pixels, and
/// kdu in those of its inverse. Throws std::invalid_argument for plumb-bob without an image size.
NearestVispCamera nearest_visp_camera(const Camera& camera);

}  // namespace kestrel
