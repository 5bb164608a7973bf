#include "kestrel/sim/scene.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "kestrel/sim/texture.hpp"

namespace kestrel {
namespace {

bool positive(double x) { return std::isfinite(x) && x > 0; }

/// Below this a rotation matrix read with six decimals still passes.
constexpr double kRotationTolerance = 1e-5;

const char* fault(const TexturedPlane& plane) {
  if (plane.texture.empty() || plane.texture.type() != CV_8UC1) {
    return "the texture must be an 8-bit grey image";
  }
  if (!positive(plane.width_m) || !positive(plane.height_m)) return "the size must be positive";
  const auto& pose = plane.world_from_target;
  if (!(rotation_defect(pose.rotation) < kRotationTolerance)) return "the pose is no rotation";
  if (!pose.translation.allFinite()) return "the position must be finite";
  if (!(plane.opacity > 0 && plane.opacity <= 1)) return "the opacity must be within (0, 1]";
  return nullptr;
}

/// Ground that faces up: x east, y south, z down; its northern edge at north 0.
TexturedPlane ground_plane(const WallOptions& o) {
  constexpr double kPxPerM = 25;  // seen from metres away and at a slant
  TexturedPlane plane;
  plane.width_m = 2 * o.wall_width_m;
  plane.height_m = o.ground_depth_m;
  plane.texture = ground(int(std::lround(plane.width_m * kPxPerM)),
                         int(std::lround(plane.height_m * kPxPerM)), o.seed + 1);
  plane.world_from_target.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  plane.world_from_target.translation << -o.ground_depth_m / 2, 0, o.ground_below_m;
  return plane;
}

TexturedPlane wall_plane(const WallOptions& o) {
  TexturedPlane plane;
  plane.width_m = o.wall_width_m;
  plane.height_m = o.wall_height_m;
  plane.texture =
      facade(int(std::lround(o.wall_width_m * o.wall_px_per_m)),
             int(std::lround(o.wall_height_m * o.wall_px_per_m)), o.wall_px_per_m, o.seed);
  plane.world_from_target = world_from_wall();
  plane.world_from_target.translation.z() = o.ground_below_m - o.wall_height_m / 2;
  return plane;
}

}  // namespace

void PlaneMotion::check() const {
  const auto require = [](bool good, const char* what) {
    if (!good) throw std::invalid_argument(what);
  };
  require(velocity_m_s.allFinite(), "velocity_m_s: must be finite");
  require(std::isfinite(start_s), "start_s: must be finite");
  require(stop_s >= start_s, "stop_s: must not be before start_s");
  require(sway_m.allFinite(), "sway_m: must be finite");
  require(positive(sway_period_s), "sway_period_s: must be positive");
  require(from_s <= until_s, "until_s: must not be before from_s");
}

Eigen::Vector3d offset(const PlaneMotion& motion, double time_s) {
  const double moving_s = std::clamp(time_s, motion.start_s, motion.stop_s) - motion.start_s;
  const double phase = 2 * M_PI * moving_s / motion.sway_period_s;
  return motion.velocity_m_s * moving_s + motion.sway_m * std::sin(phase);
}

Transform<frame::World, frame::Target> pose(const TexturedPlane& plane, double time_s) {
  auto moved = plane.world_from_target;
  moved.translation += offset(plane.motion, time_s);
  return moved;
}

const TexturedPlane& Scene::target_plane() const {
  if (planes.empty()) throw std::invalid_argument("the scene has no target");
  if (target && *target >= planes.size()) {
    throw std::invalid_argument("the scene's target is none of its planes");
  }
  return target ? planes[*target] : planes.back();
}

void Scene::check() const {
  if (target) target_plane();
  for (std::size_t i = 0; i < planes.size(); ++i) {
    planes[i].motion.check();
    if (const char* what = fault(planes[i])) {
      throw std::invalid_argument("plane " + std::to_string(i) + " of the scene: " + what);
    }
  }
  if (!(background_grey >= 0 && background_grey <= 255)) {
    throw std::invalid_argument("background_grey: must be within 0..255");
  }
}

void WallOptions::check() const {
  const auto require = [](bool good, const char* what) {
    if (!good) throw std::invalid_argument(what);
  };
  require(positive(poster_width_m), "poster_width_m: must be positive");
  require(positive(poster_height_m), "poster_height_m: must be positive");
  require(positive(wall_width_m), "wall_width_m: must be positive");
  require(positive(wall_height_m), "wall_height_m: must be positive");
  require(std::isfinite(ground_below_m), "ground_below_m: must be finite");
  require(positive(ground_depth_m), "ground_depth_m: must be positive");
  require(positive(wall_px_per_m) && wall_px_per_m <= 1000,
          "wall_px_per_m: must be within (0, 1000]");
}

Transform<frame::World, frame::Target> world_from_wall() {
  Transform<frame::World, frame::Target> pose;
  pose.rotation << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  return pose;
}

Scene wall_scene(const cv::Mat& poster, const WallOptions& options) {
  options.check();
  Scene scene;
  scene.planes.push_back(ground_plane(options));
  scene.planes.push_back(wall_plane(options));
  scene.planes.push_back(
      {poster, options.poster_width_m, options.poster_height_m, world_from_wall()});
  scene.check();
  return scene;
}

}  // namespace kestrel
