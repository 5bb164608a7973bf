#include "kestrel/sim/render.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/LU>
#include <opencv2/core.hpp>

#include "pyramid.hpp"
#include "random.hpp"

namespace kestrel {
namespace {

using sim_detail::Stream;

/// Share of a pixel below which what lies behind is no longer looked at: half a grey level.
constexpr float kOpaque = 1.f / 512;
/// Points further away than this (m) are not drawn: rays that run along a plane.
constexpr float kFar_m = 1e4f;

/// Share of the pixel in which a coordinate is below its value's distance `d` from an edge: the
/// integral up to d of the density of a uniform over [-a/2, a/2] plus one over [-b/2, b/2].
float step_over_pixel(float d, float a, float b) {
  const float wide = std::max(a, b);
  const float narrow = std::max(std::min(a, b), 1e-6f * wide + 1e-12f);
  const float outer = (wide + narrow) / 2;
  const float inner = (wide - narrow) / 2;
  if (d <= -outer) return 0;
  if (d >= outer) return 1;
  const float scale = 1 / (2 * wide * narrow);
  if (d < -inner) return (d + outer) * (d + outer) * scale;
  if (d > inner) return 1 - (outer - d) * (outer - d) * scale;
  return 0.5f + d / wide;
}

/// Share of the pixel with 0 <= s <= length, where s changes by a and b across the pixel.
float slab_over_pixel(float s, float length, float a, float b) {
  const float reach = (a + b) / 2;
  if (s >= reach && s <= length - reach) return 1;
  return step_over_pixel(s, a, b) - step_over_pixel(s - length, a, b);
}

/// Quantiles of the standard normal at the centres of n equal shares of probability.
std::vector<float> normal_quantiles(int n) {
  std::vector<float> quantiles;
  quantiles.reserve(std::size_t(n));
  double x = -4;
  for (int i = 0; i < n; ++i) {
    const double p = (i + 0.5) / n;
    for (int k = 0; k < 20; ++k) {  // Newton from the left, where the distribution is convex
      const double density = std::exp(-x * x / 2) / std::sqrt(2 * M_PI);
      x += (p - std::erfc(-x / std::sqrt(2.0)) / 2) / density;
    }
    quantiles.push_back(float(x));
  }
  return quantiles;
}

constexpr int kQuantiles = 4096;

/// Adds noise and rounds. The stream is the row's own, so rows may be made in any order.
void expose_row(const float* light, int width, std::uint8_t* grey, float noise_grey,
                const std::vector<float>& quantiles, std::uint64_t seed) {
  Stream random(seed);
  std::uint64_t bits = 0;
  for (int u = 0; u < width; ++u) {
    float value = light[u];
    if (noise_grey > 0) {
      bits = u % 5 == 0 ? random.bits() : bits >> 12;  // twelve bits a pixel
      value += noise_grey * quantiles[bits % kQuantiles];
    }
    grey[u] = std::uint8_t(std::clamp(value + 0.5f, 0.f, 255.f));
  }
}

}  // namespace

/// A plane as one pose sees it.
struct Renderer::Seen {
  const Plane* plane;
  Eigen::Matrix3f texture_from_ray;  // (s, t, 1) / depth of a ray (x, y, 1), s and t in texels
  float width;                       // of the texture, texels
  float height;
};

/// What one plane gives to one pixel.
struct Renderer::Shade {
  float cover = 0;  // share of the pixel, 0..1
  float light = 0;  // grey level, when cover > 0
};

void RenderOptions::check() const {
  if (!(std::isfinite(noise_grey) && noise_grey >= 0)) {
    throw std::invalid_argument("noise_grey: must be finite and not negative");
  }
}

Renderer::Renderer(const Scene& scene, const Camera& camera)
    : size_(camera.parameters().width, camera.parameters().height),
      background_(float(scene.background_grey)),
      normal_quantiles_(normal_quantiles(kQuantiles)) {
  scene.check();
  if (size_.empty()) throw std::invalid_argument("the camera must know its image size");
  rays_.reserve(std::size_t(size_.width + 1) * std::size_t(size_.height + 1));
  for (int v = 0; v <= size_.height; ++v) {
    for (int u = 0; u <= size_.width; ++u) {
      const ImagePoint p = camera.to_image_point({double(u), double(v)});
      rays_.emplace_back(float(p.x), float(p.y));
    }
  }
  for (const TexturedPlane& plane : scene.planes) {
    const double s = plane.texture.cols / plane.width_m;
    const double t = plane.texture.rows / plane.height_m;
    Eigen::Matrix3d texture_from_xy1;
    texture_from_xy1 << s, 0, plane.texture.cols / 2.0, 0, t, plane.texture.rows / 2.0, 0, 0, 1;
    planes_.push_back(
        {sim_detail::pyramid(plane.texture), texture_from_xy1, plane.world_from_target});
  }
}

/// Front to back. A point of the plane is depth * (x, y, 1) = [r1 r2 t] (X, Y, 1) in the camera.
std::vector<Renderer::Seen> Renderer::seen(
    const Transform<frame::World, frame::Camera>& world_from_camera) const {
  std::vector<Seen> result;
  for (auto plane = planes_.rbegin(); plane != planes_.rend(); ++plane) {
    const TargetPose pose = world_from_camera.inverse() * plane->world_from_target;
    Eigen::Matrix3d ray_from_xy1;
    ray_from_xy1 << pose.rotation.leftCols<2>(), pose.translation;
    const double distance_m = pose.rotation.col(2).dot(pose.translation);
    if (distance_m < 1e-6) continue;  // from behind, or edge on
    const Eigen::Matrix3d M = plane->texture_from_xy1 * ray_from_xy1.inverse();
    const cv::Mat& texture = plane->levels.front();
    result.push_back({&*plane, M.cast<float>(), float(texture.cols - sim_detail::kPad),
                      float(texture.rows - sim_detail::kPad)});
  }
  return result;
}

/// ray[0], ray[1] and ray[row_step] are the rays of the pixel and of its neighbours to the right
/// and below.
Renderer::Shade Renderer::shade(const Seen& seen, const Eigen::Vector2f* ray, int row_step) {
  const auto& M = seen.texture_from_ray;
  const auto at = [&M](int i, float x, float y) { return M(i, 0) * x + M(i, 1) * y; };
  const float x = ray[0].x();
  const float y = ray[0].y();
  const float w = at(2, x, y) + M(2, 2);  // 1 / depth
  if (!(w > 1 / kFar_m)) return {};
  const float depth = 1 / w;
  const float s = (at(0, x, y) + M(0, 2)) * depth;
  const float t = (at(1, x, y) + M(1, 2)) * depth;
  const Eigen::Vector2f right = ray[1] - ray[0];
  const Eigen::Vector2f down = ray[row_step] - ray[0];
  // Footprint: (s, t) change by (sa, ta) to the next pixel, by (sb, tb) to the pixel below.
  const float wa = at(2, right.x(), right.y());
  const float wb = at(2, down.x(), down.y());
  const float sa = (at(0, right.x(), right.y()) - s * wa) * depth;
  const float ta = (at(1, right.x(), right.y()) - t * wa) * depth;
  const float sb = (at(0, down.x(), down.y()) - s * wb) * depth;
  const float tb = (at(1, down.x(), down.y()) - t * wb) * depth;
  const float cover = slab_over_pixel(s, seen.width, std::abs(sa), std::abs(sb)) *
                      slab_over_pixel(t, seen.height, std::abs(ta), std::abs(tb));
  if (!(cover > 0)) return {};
  return {cover, sim_detail::mean_light(seen.plane->levels, s, t, {sa, ta, sb, tb})};
}

void Renderer::render_row(const std::vector<Seen>& planes, int v, float* row) const {
  const int row_step = size_.width + 1;
  const Eigen::Vector2f* ray = rays_.data() + std::size_t(v) * std::size_t(row_step);
  for (int u = 0; u < size_.width; ++u, ++ray) {
    float light = 0;
    float open = 1;  // share of the pixel that nothing covers yet
    for (const Seen& plane : planes) {
      const Shade shaded = shade(plane, ray, row_step);
      light += open * shaded.cover * shaded.light;
      open *= 1 - shaded.cover;
      if (open < kOpaque) break;
    }
    row[u] = light + open * background_;
  }
}

cv::Mat Renderer::view(const Transform<frame::World, frame::Camera>& world_from_camera,
                       const RenderOptions& options) const {
  options.check();
  if (!world_from_camera.rotation.allFinite() || !world_from_camera.translation.allFinite()) {
    throw std::invalid_argument("world_from_camera: must be finite");
  }
  const std::vector<Seen> planes = seen(world_from_camera);
  const std::uint64_t seed = sim_detail::derived_seed(options.seed, std::uint64_t(options.frame));
  cv::Mat picture(size_, CV_8U);
  cv::parallel_for_(cv::Range(0, size_.height), [&](const cv::Range& rows) {
    std::vector<float> light(std::size_t(size_.width));
    for (int v = rows.start; v < rows.end; ++v) {
      render_row(planes, v, light.data());
      expose_row(light.data(), size_.width, picture.ptr(v), float(options.noise_grey),
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
