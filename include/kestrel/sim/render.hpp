#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "kestrel/geometry/camera.hpp"
#include "kestrel/geometry/transform.hpp"
#include "kestrel/sim/scene.hpp"

namespace kestrel {

/// What the sensor adds to the light.
struct RenderOptions {
  double noise_grey = 0;   // standard deviation of Gaussian noise, grey levels
  std::uint64_t seed = 0;  // of the noise; the same seed and frame give the same noise
  std::int64_t frame = 0;

  /// Throws std::invalid_argument for a negative or non-finite noise.
  void check() const;
};

/// A camera looking at a scene. Each pixel is the mean light over its square, [u - 0.5, u + 0.5] x
/// [v - 0.5, v + 0.5]: a ray is cast through the lens at its centre and the pixel's footprint on
/// the first plane it meets is integrated over a pyramid of the texture (as many taps as the
/// footprint is long, each from the level whose texels they just cover); edges blend by the share
/// of the pixel they cover. The same bytes at any number of threads.
class Renderer {
 public:
  /// Throws std::invalid_argument for a scene that does not check or a camera without image size.
  Renderer(const Scene& scene, const Camera& camera);

  /// The picture, 8-bit grey, of the camera's size. Throws std::invalid_argument for a pose that
  /// is not finite.
  cv::Mat view(const Transform<frame::World, frame::Camera>& world_from_camera,
               const RenderOptions& options = {}) const;

 private:
  struct Plane {
    std::vector<cv::Mat> levels;       // of the texture, each half as large as the one before
    Eigen::Matrix3d texture_from_xy1;  // texels, outer edges, of a point (x, y, 1) of the plane, m
    Transform<frame::World, frame::Target> world_from_target;
  };
  struct Seen;
  struct Shade;
  static Shade shade(const Seen& plane, const Eigen::Vector2f* ray, int row_step);
  std::vector<Seen> seen(const Transform<frame::World, frame::Camera>& world_from_camera) const;
  void render_row(const std::vector<Seen>& planes, int v, float* row) const;

  cv::Size size_;
  std::vector<Eigen::Vector2f> rays_;  // (size_ + 1) normalised points, row by row
  std::vector<Plane> planes_;
  float background_ = 0;
  std::vector<float> normal_quantiles_;
};

/// One view of a scene: Renderer(scene, camera).view(...), for those who need no second one.
cv::Mat render(const Scene& scene, const Camera& camera,
               const Transform<frame::World, frame::Camera>& world_from_camera,
               const RenderOptions& options = {});

}  // namespace kestrel
