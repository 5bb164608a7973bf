#pragma once

#include "kestrel/geometry/transform.hpp"
#include "kestrel/servo/control_law.hpp"

namespace kestrel::laws {

/// cVb S: the camera's twists for the body's forward, right, down and, for four columns, turn.
TwistBasis body_basis(const Mount& body_from_camera, int columns);

/// -(A3)^+ a_r r: the velocity (m/s, level body) that keeps the image still while the helicopter
/// turns, as far as three translations can. Zero for laws that tell a turn from a translation.
Eigen::Vector3d against_turn(Law law, const LawInput& input, const Mount& body_from_camera,
                             double turn_rad_s);

}  // namespace kestrel::laws
