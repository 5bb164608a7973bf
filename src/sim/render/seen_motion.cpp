#include "seen_motion.hpp"

#include <algorithm>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace kestrel::sim_detail {
namespace {

constexpr int kAcross = 9;
constexpr int kDown = 7;

/// The frontmost plane that a ray meets; null for none, and for a ray that is no number.
const SeenPlane* plane_at(const View& view, const Eigen::Vector3f& ray) {
  const auto is_met = [&](const SeenPlane& plane) {
    return extent(plane, {ray, ray, ray, ray}) == Extent::All;
  };
  const auto met = std::find_if(view.planes.begin(), view.planes.end(), is_met);
  return met == view.planes.end() ? nullptr : &*met;
}

/// Where the same texel is seen; the ray itself where the plane is not there any more.
Eigen::Vector2f moved(const View& view, const SeenPlane& plane, const Eigen::Vector3f& ray) {
  for (const SeenPlane& same : view.planes) {
    if (same.texture != plane.texture) continue;
    return (same.texture_from_ray.inverse() * (plane.texture_from_ray * ray)).hnormalized();
  }
  return ray.head<2>();
}

}  // namespace

double farthest_motion(const View& first, const View& second, const Rays& rays) {
  float farthest = 0;
  for (int k = 0; k < kAcross * kDown; ++k) {
    const Eigen::Vector3f ray = rays.ray((rays.size().width - 1) * (k % kAcross) / (kAcross - 1),
                                         (rays.size().height - 1) * (k / kAcross) / (kDown - 1));
    const SeenPlane* const plane = plane_at(first, ray);
    if (plane) farthest = std::max(farthest, (moved(second, *plane, ray) - ray.head<2>()).norm());
  }
  return double(farthest);
}

}  // namespace kestrel::sim_detail
