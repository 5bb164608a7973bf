#pragma once

#include <vector>

#include "kestrel/calibration/calibration_verdict.hpp"

namespace kestrel {

/// What speaks against the numbers of a camera alone: a focal length, pixels or a centre that no
/// usual camera has, a lens that folds over inside the image.
std::vector<Objection> lens_objections(const CameraParameters& camera);

}  // namespace kestrel
