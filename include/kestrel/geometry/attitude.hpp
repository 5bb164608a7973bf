#pragma once

#include <Eigen/Core>

namespace kestrel {

/// Attitude of the helicopter: rotation of Body against the local level frame NED, in the order
/// yaw, pitch, roll (Rz Ry Rx), rad. Positive: right side down, nose up, clockwise from above.
struct Attitude {
  double roll = 0;
  double pitch = 0;
  double yaw = 0;
};

/// Rotation that takes vectors of Body into the heading frame (levelled, same yaw): Ry(pitch)
/// Rx(roll).
Eigen::Matrix3d level_from_body(const Attitude& attitude);

/// Rotation that takes vectors of the tilted camera into the camera as it would be mounted on the
/// levelled helicopter: m_level = body_from_camera^T Ry(pitch) Rx(roll) body_from_camera m.
Eigen::Matrix3d level_camera_from_camera(const Eigen::Matrix3d& body_from_camera,
                                         const Attitude& attitude);

}  // namespace kestrel
