#include "seen_plane.hpp"

#include <algorithm>

namespace kestrel::sim_detail {

/// Each edge, and depth, is a linear function of the ray that is positive within: if it has one
/// sign at the corners it has the same between them.
Extent extent(const SeenPlane& plane, const std::array<Eigen::Vector3f, 4>& rays) {
  std::array<int, 5> within{};
  std::array<int, 5> beyond{};
  for (const Eigen::Vector3f& ray : rays) {
    const Eigen::Vector3f at = plane.texture_from_ray * ray;
    const std::array<float, 5> margin{at.x(), plane.texture->width() * at.z() - at.x(), at.y(),
                                      plane.texture->height() * at.z() - at.y(),
                                      at.z() - kNearlyAlong};
    for (std::size_t i = 0; i < margin.size(); ++i) {
      within[i] += margin[i] > 0 ? 1 : 0;
      beyond[i] += margin[i] < 0 ? 1 : 0;
    }
  }
  if (*std::max_element(beyond.begin(), beyond.end()) == 4) return Extent::None;
  if (*std::min_element(within.begin(), within.end()) == 4) return Extent::All;
  return Extent::Part;
}

bool is_even(const SeenPlane& plane, const std::array<Eigen::Vector3f, 4>& rays) {
  constexpr float kRatio = 1.06f;
  const auto inverse_depth = plane.texture_from_ray.row(2);
  float least = inverse_depth.dot(rays[0]);
  float most = least;
  for (const Eigen::Vector3f& ray : rays) {
    least = std::min(least, inverse_depth.dot(ray));
    most = std::max(most, inverse_depth.dot(ray));
  }
  return least > kNearlyAlong && most <= kRatio * least;
}

Footprint footprint(const SeenPlane& plane, const Eigen::Vector3f& ray,
                    const Eigen::Vector3f& right, const Eigen::Vector3f& below) {
  const Eigen::Vector3f at = plane.texture_from_ray * ray;
  const auto step = [&](const Eigen::Vector3f& to) -> Eigen::Vector2f {
    const Eigen::Vector3f d = plane.texture_from_ray * (to - ray);
    return (d.head<2>() - at.head<2>() / at.z() * d.z()) / at.z();
  };
  const Eigen::Vector2f a = step(right);
  const Eigen::Vector2f b = step(below);
  return {a.x(), a.y(), b.x(), b.y()};
}

}  // namespace kestrel::sim_detail
