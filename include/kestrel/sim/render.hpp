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
  double gain = 1;        // of all light, before the noise
  double vignetting = 0;  // share of the light that is missing in the farthest corner; grows with
                          // the square of the distance from the picture's centre

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// Where the camera is at an instant.
struct CameraAt {
  double time_s = 0;  // for planes that move
  Transform<frame::World, frame::Camera> world_from_camera;
};

/// Rows from this one to the next band's, and where the camera is while they are exposed: equal
/// shares of the light each.
struct Band {
  int first_row = 0;
  std::vector<CameraAt> during;
};

/// How a picture is taken: bands by rising row, the first from row 0.
using Shot = std::vector<Band>;

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

  /// The same while camera and planes move. Throws std::invalid_argument also for a shot without
  /// bands, a band without a place, or rows that do not rise from 0.
  cv::Mat expose(const Shot& shot, const RenderOptions& options = {}) const;

 private:
  struct Plane;
  struct Seen;
  struct Shades;
  static Shades shades(const Seen& plane, const float* ray_x, const float* ray_y, int stride);
  std::vector<Seen> seen(const CameraAt& camera) const;
  std::vector<float> light(const std::vector<Seen>& planes, int row) const;
  std::vector<float> light(const std::vector<std::vector<Seen>>& views, int row) const;
  void attenuate(std::vector<float>& light, int row, const RenderOptions& options) const;

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
