#pragma once

#include <cstdint>
#include <memory>
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
/// the first plane it meets is integrated over a pyramid of the texture (from the level on which
/// the footprint is one tap wide, with as many taps as it is then long); edges blend by
/// the share of the pixel they cover. The same bytes at any number of threads.
class Renderer {
 public:
  /// Throws std::invalid_argument for a scene that does not check or a camera without image size.
  Renderer(const Scene& scene, const Camera& camera);

  /// The picture, 8-bit grey, of the camera's size. Throws std::invalid_argument for a pose that
  /// is not finite.
  cv::Mat view(const Transform<frame::World, frame::Camera>& world_from_camera,
               const RenderOptions& options = {}) const;

 private:
  struct Plane;
  struct Seen;
  struct Shades;
  static Shades shades(const Seen& plane, const float* ray_x, const float* ray_y, int stride);
  std::vector<Seen> seen(const Transform<frame::World, frame::Camera>& world_from_camera) const;
  std::vector<float> light(const std::vector<Seen>& planes, int row) const;

  cv::Size size_;
  int stride_;                // of the rays: the width and one more, in whole runs
  std::vector<float> ray_x_;  // normalised points of the pixels and one row more
  std::vector<float> ray_y_;
  std::shared_ptr<const std::vector<Plane>> planes_;  // never changed: copies may share them
  float background_;
  std::vector<float> normal_quantiles_;
};

/// One view of a scene: Renderer(scene, camera).view(...), for those who need no second one.
cv::Mat render(const Scene& scene, const Camera& camera,
               const Transform<frame::World, frame::Camera>& world_from_camera,
               const RenderOptions& options = {});

}  // namespace kestrel
