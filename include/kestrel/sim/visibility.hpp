#pragma once

#include "kestrel/geometry/camera.hpp"
#include "kestrel/sim/render.hpp"
#include "kestrel/sim/scene.hpp"

namespace kestrel {

/// Share of the scene's target that a camera sees, 0 to 1: of 16 x 12 points spread over it, those
/// whose pixel lies in the image and that no plane drawn after it hides. What is half transparent
/// or more, a shadow for instance, hides nothing. 0 from behind. Throws std::invalid_argument for a
/// scene without a target.
double visible_share(const Scene& scene, const Camera& camera, const CameraAt& at);

}  // namespace kestrel
