#pragma once

#include <optional>
#include <string>

#include "kestrel/geometry/camera.hpp"
#include "kestrel/geometry/transform.hpp"

namespace kestrel {

/// A mount seen from the helicopter's right side and from above, an SVG document: the body's axes
/// (x forward, y right, z down), the camera's (x image right, y image down, z into the scene), its
/// field of view and the outline of a helicopter (no particular one). Without a camera, or with one
/// whose image size is unknown, the field of view is drawn 60 by 45 degrees wide and said to be
/// unknown.
std::string mount_picture(const Mount& body_from_camera, const std::optional<Camera>& camera);

}  // namespace kestrel
