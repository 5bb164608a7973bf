#pragma once

#include <string>
#include <vector>

#include "kestrel/geometry/transform.hpp"

namespace kestrel {

/// A mount drawn in characters, for a terminal, line by line: the helicopter from above and from
/// its right, the camera (o) in the middle and where it looks (o..*); a camera that looks away from
/// who looks at the drawing is x, one that looks at them @. Its place is not drawn.
std::vector<std::string> mount_sketch(const Mount& body_from_camera);

}  // namespace kestrel
