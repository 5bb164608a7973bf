#include "kestrel/sim/render.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/LU>
#include <opencv2/core.hpp>

#include "coverage.hpp"
#include "exposure.hpp"
#include "pyramid.hpp"
#include "taps.hpp"

namespace kestrel {
namespace {

using sim_detail::kNearlyAlong;
using sim_detail::kRun;
using sim_detail::Run;

/// Where rays meet the plane, texels from the texture's outer edge, and 1 / depth, 1/m.
struct OnTexture {
  Run s;
  Run t;
  Run w;
};

OnTexture on_texture(const Eigen::Matrix3f& texture_from_ray, const float* ray_x,
                     const float* ray_y) {
  const auto row = [&](int i) {
    const float a = texture_from_ray(i, 0);
    const float b = texture_from_ray(i, 1);
    const float c = texture_from_ray(i, 2);
    Run values;
    for (std::size_t k = 0; k < kRun; ++k) values[k] = a * ray_x[k] + b * ray_y[k] + c;
    return values;
  };
  OnTexture at{row(0), row(1), row(2)};
  Run depth;
  for (std::size_t k = 0; k < kRun; ++k) depth[k] = std::max(kNearlyAlong, at.w[k]);
  for (float& z : depth) z = 1 / z;
  for (std::size_t k = 0; k < kRun; ++k) at.s[k] *= depth[k];
  for (std::size_t k = 0; k < kRun; ++k) at.t[k] *= depth[k];
  return at;
}

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

}  // namespace

struct Renderer::Plane {
  sim_detail::Pyramid texture;
  Eigen::Matrix3d texture_from_xy1;  // texels from the outer edge, of (x, y, 1) on the plane, m
  Transform<frame::World, frame::Target> world_from_target;
  float opacity;
  PlaneMotion motion;
};

/// A plane as one pose sees it.
struct Renderer::Seen {
  const sim_detail::Pyramid* texture;
  Eigen::Matrix3f texture_from_ray;  // (s, t, 1) / depth of a ray (x, y, 1), s and t in texels
  float opacity;
};

/// What one plane gives to a run of pixels.
struct Renderer::Shades {
  Run cover{};  // share of the pixel, 0..1
  Run light{};  // grey level, where cover > 0
};

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

Renderer::Renderer(const Scene& scene, const Camera& camera)
    : size_(camera.parameters().width, camera.parameters().height),
      stride_((size_.width / kRun + 1) * kRun),
      background_(float(scene.background_grey)),
      normal_quantiles_(sim_detail::normal_quantiles()) {
  scene.check();
  if (size_.empty()) throw std::invalid_argument("the camera must know its image size");
  for (int v = 0; v <= size_.height; ++v) {
    for (int u = 0; u < stride_; ++u) {
      const ImagePoint p = camera.to_image_point({double(u), double(v)});
      ray_x_.push_back(float(p.x));
      ray_y_.push_back(float(p.y));
    }
  }
  std::vector<Plane> planes;
  for (const TexturedPlane& plane : scene.planes) {
    const double s = plane.texture.cols / plane.width_m;
    const double t = plane.texture.rows / plane.height_m;
    Eigen::Matrix3d texture_from_xy1;
    texture_from_xy1 << s, 0, plane.texture.cols / 2.0, 0, t, plane.texture.rows / 2.0, 0, 0, 1;
    planes.push_back({sim_detail::pyramid(plane.texture), texture_from_xy1, plane.world_from_target,
                      float(plane.opacity), plane.motion});
  }
  planes_ = std::make_shared<const std::vector<Plane>>(std::move(planes));
}

/// Front to back. A point of the plane is depth * (x, y, 1) = [r1 r2 t] (X, Y, 1) in the camera.
std::vector<Renderer::Seen> Renderer::seen(const CameraAt& camera) const {
  std::vector<Seen> result;
  const auto camera_from_world = camera.world_from_camera.inverse();
  for (auto plane = planes_->rbegin(); plane != planes_->rend(); ++plane) {
    if (!plane->motion.is_there(camera.time_s)) continue;
    auto world_from_target = plane->world_from_target;
    world_from_target.translation += offset(plane->motion, camera.time_s);
    const TargetPose pose = camera_from_world * world_from_target;
    Eigen::Matrix3d ray_from_xy1;
    ray_from_xy1 << pose.rotation.leftCols<2>(), pose.translation;
    const double distance_m = pose.rotation.col(2).dot(pose.translation);
    if (distance_m < 1e-6) continue;  // from behind, or edge on
    const Eigen::Matrix3d M = plane->texture_from_xy1 * ray_from_xy1.inverse();
    result.push_back({&plane->texture, M.cast<float>(), plane->opacity});
  }
  return result;
}

/// ray_x[k] and ray_x[k + stride] belong to a pixel of the run and to the one below it. The shape
/// of the footprint is taken to be the same along the run.
Renderer::Shades Renderer::shades(const Seen& seen, const float* ray_x, const float* ray_y,
                                  int stride) {
  const auto [s, t, w] = on_texture(seen.texture_from_ray, ray_x, ray_y);
  const int k = sim_detail::pixel_on_plane(w);
  if (k < 0) return {};
  const auto step = [&, s0 = s[std::size_t(k)], t0 = t[std::size_t(k)],
                     w0 = w[std::size_t(k)]](int neighbour) -> Eigen::Vector2f {
    const Eigen::Vector3f d =
        seen.texture_from_ray *
        Eigen::Vector3f(ray_x[k + neighbour] - ray_x[k], ray_y[k + neighbour] - ray_y[k], 0);
    return Eigen::Vector2f(d.x() - s0 * d.z(), d.y() - t0 * d.z()) / w0;
  };
  const Eigen::Vector2f right = step(1);
  const Eigen::Vector2f down = step(stride);
  if (!right.allFinite() || !down.allFinite()) return {};
  Shades shades;
  shades.cover =
      sim_detail::cover(w, sim_detail::slabs(w, s, seen.texture->width, right.x(), down.x()),
                        sim_detail::slabs(w, t, seen.texture->height, right.y(), down.y()));
  if (sim_detail::is_all(shades.cover, 0)) return shades;
  shades.light =
      sim_detail::mean_light(*seen.texture, s, t, {right.x(), right.y(), down.x(), down.y()});
  return shades;
}

std::vector<float> Renderer::light(const std::vector<Seen>& planes, int row) const {
  std::vector<float> result(static_cast<std::size_t>(stride_));
  const std::size_t first = std::size_t(row) * std::size_t(stride_);
  for (std::size_t u = 0; u < std::size_t(size_.width); u += kRun) {
    Run light{};
    Run open;  // share of the pixel that nothing covers yet
    open.fill(1);
    for (const Seen& plane : planes) {
      const Shades shaded = shades(plane, &ray_x_[first + u], &ray_y_[first + u], stride_);
      for (std::size_t k = 0; k < kRun; ++k) {
        const float cover = shaded.cover[k] * plane.opacity;
        light[k] += open[k] * cover * shaded.light[k];
        open[k] *= 1 - cover;
      }
      if (sim_detail::is_all(open, 0)) break;
    }
    for (std::size_t k = 0; k < kRun; ++k) result[u + k] = light[k] + open[k] * background_;
  }
  return result;
}

std::vector<float> Renderer::light(const std::vector<std::vector<Seen>>& views, int row) const {
  std::vector<float> sum = light(views.front(), row);
  if (views.size() == 1) return sum;
  for (std::size_t i = 1; i < views.size(); ++i) {
    const std::vector<float> more = light(views[i], row);
    for (std::size_t u = 0; u < sum.size(); ++u) sum[u] += more[u];
  }
  const float share = 1 / float(views.size());
  for (float& each : sum) each *= share;
  return sum;
}

void Renderer::attenuate(std::vector<float>& light, int row, const RenderOptions& options) const {
  if (options.gain == 1 && options.vignetting == 0) return;
  const double cx = (size_.width - 1) / 2.0;
  const double cy = (size_.height - 1) / 2.0;
  const double per_corner = options.vignetting / std::max(1.0, cx * cx + cy * cy);
  for (int u = 0; u < size_.width; ++u) {
    const double r2 = (u - cx) * (u - cx) + (row - cy) * (row - cy);
    light[std::size_t(u)] *= float(options.gain * (1 - per_corner * r2));
  }
}

cv::Mat Renderer::view(const Transform<frame::World, frame::Camera>& world_from_camera,
                       const RenderOptions& options) const {
  return expose(Shot{{0, {{0, world_from_camera}}}}, options);
}

cv::Mat Renderer::expose(const Shot& shot, const RenderOptions& options) const {
  options.check();
  check(shot);
  std::vector<std::vector<std::vector<Seen>>> bands;
  for (const Band& band : shot) {
    bands.emplace_back();
    for (const CameraAt& camera : band.during) bands.back().push_back(seen(camera));
  }
  const auto band_of = [&](int row) {
    const auto after = std::upper_bound(shot.begin(), shot.end(), row,
                                        [](int r, const Band& b) { return r < b.first_row; });
    return std::size_t(after - shot.begin()) - 1;
  };
  const std::uint64_t seed = sim_detail::derived_seed(options.seed, std::uint64_t(options.frame));
  cv::Mat picture(size_, CV_8U);
  cv::parallel_for_(cv::Range(0, size_.height), [&](const cv::Range& rows) {
    for (int v = rows.start; v < rows.end; ++v) {
      std::vector<float> row = light(bands[band_of(v)], v);
      attenuate(row, v, options);
      sim_detail::expose_row(row, size_.width, picture.ptr(v), float(options.noise_grey),
                             normal_quantiles_, sim_detail::derived_seed(seed, std::uint64_t(v)));
    }
  });
  return picture;
}

cv::Mat render(const Scene& scene, const Camera& camera,
               const Transform<frame::World, frame::Camera>& world_from_camera,
               const RenderOptions& options) {
  return Renderer(scene, camera).view(world_from_camera, options);
}

}  // namespace kestrel
