#include "kestrel/servo/latency.hpp"

#include <cmath>

namespace kestrel {
namespace {

double area(const std::vector<Feature>& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ImagePoint& a = polygon[i].at;
    const ImagePoint& b = polygon[(i + 1) % polygon.size()].at;
    twice += a.x * b.y - b.x * a.y;
  }
  return std::abs(twice) / 2;
}

}  // namespace

std::vector<Feature> with_area_depth(const std::vector<Feature>& measured,
                                     const std::vector<Feature>& desired) {
  if (measured.size() < 3 || measured.size() != desired.size()) return {};
  double goal_depth_m = 0;
  for (const Feature& f : desired) goal_depth_m += f.depth_m / double(desired.size());
  const double depth_m = goal_depth_m * std::sqrt(area(desired) / area(measured));
  if (!std::isfinite(depth_m) || depth_m <= 0) return {};
  std::vector<Feature> seen = measured;
  for (Feature& f : seen) f.depth_m = depth_m;
  return seen;
}

std::vector<Feature> predicted(const std::vector<Feature>& features,
                               const CameraMotion& now_from_then) {
  std::vector<Feature> seen;
  seen.reserve(features.size());
  for (const Feature& f : features) {
    const Eigen::Vector3d p = now_from_then * (f.depth_m * Eigen::Vector3d(f.at.x, f.at.y, 1));
    seen.push_back({{p.x() / p.z(), p.y() / p.z()}, p.z()});
  }
  return seen;
}

}  // namespace kestrel
