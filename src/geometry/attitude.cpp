#include "kestrel/geometry/attitude.hpp"

#include "kestrel/geometry/rotation.hpp"

namespace kestrel {

Eigen::Matrix3d level_from_body(const Attitude& attitude) {
  return rotation_from_rpy(attitude.roll, attitude.pitch, 0);
}

Eigen::Matrix3d level_camera_from_camera(const Eigen::Matrix3d& body_from_camera,
                                         const Attitude& attitude) {
  return body_from_camera.transpose() * level_from_body(attitude) * body_from_camera;
}

}  // namespace kestrel
