#include "kestrel/sim/render.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/LU>
#include <opencv2/core.hpp>
#include <opencv2/core/utility.hpp>

#include "render/exposure.hpp"
#include "render/rays.hpp"
#include "render/seen_motion.hpp"
#include "render/tile_light.hpp"

namespace kestrel {
namespace {

using sim_detail::Exposure;
using sim_detail::kernels;
using sim_detail::Rays;
using sim_detail::SeenPlane;
using sim_detail::View;

void check(const Shot& shot) {
  int before = -1;
  for (const Band& band : shot) {
    if (band.during.empty()) throw std::invalid_argument("a band of the shot has no place");
    if (band.first_row <= before) throw std::invalid_argument("rows of the shot do not rise");
    before = band.first_row;
    for (const CameraAt& camera : band.during) {
      const auto& pose = camera.world_from_camera;
      if (!pose.rotation.allFinite() || !pose.translation.allFinite()) {
        throw std::invalid_argument("world_from_camera: must be finite");
      }
    }
  }
  if (shot.empty() || shot.front().first_row != 0) {
    throw std::invalid_argument("a shot must begin with row 0");
  }
}

/// Rows that are exposed at the same instants, and few enough for a tile.
struct Strip {
  int row;
  int rows;
  std::size_t band;
};

std::vector<Strip> strips(const Shot& shot, int height) {
  std::vector<Strip> all;
  for (std::size_t b = 0; b < shot.size(); ++b) {
    const int end = b + 1 < shot.size() ? std::min(shot[b + 1].first_row, height) : height;
    for (int row = shot[b].first_row; row < end; row += sim_detail::kRun) {
      all.push_back({row, std::min(sim_detail::kRun, end - row), b});
    }
  }
  return all;
}

struct Plane {
  explicit Plane(const TexturedPlane& plane)
      : texture(plane.texture),
        world_from_target(plane.world_from_target),
        opacity(float(plane.opacity)),
        motion(plane.motion) {
    const double s = plane.texture.cols / plane.width_m;
    const double t = plane.texture.rows / plane.height_m;
    texture_from_xy1 << s, 0, plane.texture.cols / 2.0, 0, t, plane.texture.rows / 2.0, 0, 0, 1;
  }

  sim_detail::Pyramid texture;
  Eigen::Matrix3d texture_from_xy1;  // texels from the outer edge, of (x, y, 1) on the plane, m
  Transform<frame::World, frame::Target> world_from_target;
  float opacity;
  PlaneMotion motion;
};

}  // namespace

void RenderOptions::check() const {
  if (!(std::isfinite(noise_grey) && noise_grey >= 0)) {
    throw std::invalid_argument("noise_grey: must be finite and not negative");
  }
  if (!(std::isfinite(gain) && gain >= 0)) {
    throw std::invalid_argument("gain: must be finite and not negative");
  }
  if (!(vignetting >= 0 && vignetting <= 1)) {
    throw std::invalid_argument("vignetting: must be within [0, 1]");
  }
}

struct Renderer::Parts {
  Parts(const Scene& scene, const Camera& camera)
      : focal_px(std::max(camera.parameters().px, camera.parameters().py)),
        rays(camera),
        planes(scene.planes.rbegin(), scene.planes.rend()),
        background(float(scene.background_grey)) {}

  View view(const CameraAt& camera, Simd simd) const;

  double focal_px;
  Rays rays;
  std::vector<Plane> planes;  // front to back
  float background;
};

Renderer::Renderer(const Scene& scene, const Camera& camera) {
  scene.check();
  if (camera.parameters().width <= 0 || camera.parameters().height <= 0) {
    throw std::invalid_argument("the camera must know its image size");
  }
  parts_ = std::make_shared<const Parts>(scene, camera);
}

cv::Size Renderer::size() const { return parts_->rays.size(); }

/// A point of the plane is depth * (x, y, 1) = [r1 r2 t] (X, Y, 1) in the camera.
View Renderer::Parts::view(const CameraAt& camera, Simd simd) const {
  View view{{}, background, kernels(use_avx2(simd)).add_mean_light};
  const auto camera_from_world = camera.world_from_camera.inverse();
  for (const Plane& plane : planes) {
    if (!plane.motion.is_there(camera.time_s)) continue;
    auto world_from_target = plane.world_from_target;
    world_from_target.translation += offset(plane.motion, camera.time_s);
    const TargetPose pose = camera_from_world * world_from_target;
    Eigen::Matrix3d ray_from_xy1;
    ray_from_xy1 << pose.rotation.leftCols<2>(), pose.translation;
    const double distance_m = pose.rotation.col(2).dot(pose.translation);
    if (distance_m < 1e-6) continue;  // from behind, or edge on
    const Eigen::Matrix3d M = plane.texture_from_xy1 * ray_from_xy1.inverse();
    view.planes.push_back({&plane.texture, M.cast<float>(), plane.opacity});
  }
  return view;
}

cv::Mat Renderer::view(const Transform<frame::World, frame::Camera>& world_from_camera,
                       const RenderOptions& options) const {
  return expose(Shot{{0, {{0, world_from_camera}}}}, options);
}

cv::Mat Renderer::expose(const Shot& shot, const RenderOptions& options) const {
  options.check();
  check(shot);
  std::vector<std::vector<View>> bands;
  for (const Band& band : shot) {
    bands.emplace_back();
    for (const CameraAt& camera : band.during) {
      bands.back().push_back(parts_->view(camera, options.simd));
    }
  }
  const Rays& rays = parts_->rays;
  const std::vector<Strip> all = strips(shot, rays.size().height);
  cv::Mat picture(rays.size(), CV_8U);
  const Exposure exposure(picture.size(), options, kernels(use_avx2(options.simd)).sense);
  cv::parallel_for_(cv::Range(0, int(all.size())), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) {
      const Strip& strip = all[std::size_t(i)];
      const std::vector<View>& views = bands[strip.band];
      for (int u = 0; u < picture.cols; u += sim_detail::kRun) {
        const sim_detail::Tile tile{u, strip.row, strip.rows};
        exposure.expose(sum_of_views(views, rays, tile), views.size(), tile, picture);
      }
    }
  });
  return picture;
}

double Renderer::motion_px(const CameraAt& from, const CameraAt& to) const {
  const View first = parts_->view(from, Simd::Baseline);
  const View second = parts_->view(to, Simd::Baseline);
  return parts_->focal_px * sim_detail::farthest_motion(first, second, parts_->rays);
}

cv::Mat render(const Scene& scene, const Camera& camera,
               const Transform<frame::World, frame::Camera>& world_from_camera,
               const RenderOptions& options) {
  return Renderer(scene, camera).view(world_from_camera, options);
}

}  // namespace kestrel
