#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "kestrel/geometry/camera.hpp"
#include "kestrel/geometry/transform.hpp"
#include "kestrel/sim/scene.hpp"
#include "kestrel/vision/simd.hpp"

namespace kestrel {

/// What the sensor adds to the light.
struct RenderOptions {
  double noise_grey = 0;   // standard deviation of Gaussian noise, grey levels
  std::uint64_t seed = 0;  // of the noise; the same seed and frame give the same noise
  std::int64_t frame = 0;
  double gain = 1;         // of all light, before the noise
  double vignetting = 0;   // share of the light that is missing in the farthest corner; grows with
                           // the square of the distance from the picture's centre
  Simd simd = Simd::Auto;  // the same bytes with either

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
/// the first plane it meets is integrated over the texture, or over a pyramid of its means where
/// it spans several texels; edges blend by the share of the pixel they cover. The same bytes at any
/// number of threads.
class Renderer {
 public:
  /// Throws std::invalid_argument for a scene that does not check or a camera without image size.
  Renderer(const Scene& scene, const Camera& camera);

  cv::Size size() const;  // of the picture, px

  /// The picture, 8-bit grey, of the camera's size. Throws std::invalid_argument for a pose that
  /// is not finite.
  cv::Mat view(const Transform<frame::World, frame::Camera>& world_from_camera,
               const RenderOptions& options = {}) const;

  /// The same while camera and planes move. Throws std::invalid_argument also for a shot without
  /// bands, a band without a place, or rows that do not rise from 0.
  cv::Mat expose(const Shot& shot, const RenderOptions& options = {}) const;

  /// How far in the picture, px, what is seen from one place lies from where the other shows it:
  /// the most on a grid of 9x7 pixels, border to border. 0 where nothing is seen.
  double motion_px(const CameraAt& from, const CameraAt& to) const;

 private:
  struct Parts;
  std::shared_ptr<const Parts> parts_;  // never changed: copies may share them
};

/// One view of a scene: Renderer(scene, camera).view(...), for those who need no second one.
cv::Mat render(const Scene& scene, const Camera& camera,
               const Transform<frame::World, frame::Camera>& world_from_camera,
               const RenderOptions& options = {});

}  // namespace kestrel
