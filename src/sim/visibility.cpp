#include "kestrel/sim/visibility.hpp"

#include <cmath>

namespace kestrel {
namespace {

constexpr int kAcross = 16;
constexpr int kDown = 12;

bool is_in_image(const Camera& camera, const Eigen::Vector3d& in_camera) {
  if (!(in_camera.z() > 0)) return false;
  const Pixel at = camera.to_pixel({in_camera.x() / in_camera.z(), in_camera.y() / in_camera.z()});
  const CameraParameters& p = camera.parameters();
  return at.u >= -0.5 && at.u < p.width - 0.5 && at.v >= -0.5 && at.v < p.height - 0.5;
}

/// Whether the plane is drawn where this point of the world is seen. The renderer's order is that
/// of the scene, not that of the distance, and so is this.
bool hides(const TexturedPlane& plane, const CameraAt& at, const Eigen::Vector3d& in_world) {
  if (plane.opacity < 0.5 || !plane.motion.is_there(at.time_s)) return false;
  const auto plane_from_world = pose(plane, at.time_s).inverse();
  const Eigen::Vector3d eye = plane_from_world * at.world_from_camera.translation;
  const Eigen::Vector3d ray = plane_from_world * in_world - eye;
  if (!(eye.z() < 0) || !(ray.z() > 0)) return false;
  const Eigen::Vector3d met = eye - eye.z() / ray.z() * ray;
  return std::abs(met.x()) <= plane.width_m / 2 && std::abs(met.y()) <= plane.height_m / 2;
}

}  // namespace

double visible_share(const Scene& scene, const Camera& camera, const CameraAt& at) {
  const TexturedPlane& target = scene.target_plane();
  if (!target.motion.is_there(at.time_s)) return 0;
  const auto world_from_target = pose(target, at.time_s);
  const auto camera_from_world = at.world_from_camera.inverse();
  const Eigen::Vector3d eye = world_from_target.inverse() * at.world_from_camera.translation;
  if (!(eye.z() < 0)) return 0;
  const std::size_t first_after = std::size_t(&target - scene.planes.data()) + 1;
  int seen = 0;
  for (int k = 0; k < kAcross * kDown; ++k) {
    const int row = k / kAcross;
    const double x = ((k % kAcross + 0.5) / kAcross - 0.5) * target.width_m;
    const double y = ((row + 0.5) / kDown - 0.5) * target.height_m;
    const Eigen::Vector3d in_world = world_from_target * Eigen::Vector3d(x, y, 0);
    bool is_open = is_in_image(camera, camera_from_world * in_world);
    for (std::size_t i = first_after; is_open && i < scene.planes.size(); ++i) {
      is_open = !hides(scene.planes[i], at, in_world);
    }
    seen += is_open ? 1 : 0;
  }
  return double(seen) / (kAcross * kDown);
}

}  // namespace kestrel
