#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "kestrel/geometry/transform.hpp"

namespace kestrel {

/// How a plane moves without turning, and when it is there.
struct PlaneMotion {
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();  // NED, from start_s to stop_s
  double start_s = 0;
  double stop_s = std::numeric_limits<double>::infinity();
  Eigen::Vector3d sway_m =
      Eigen::Vector3d::Zero();  // NED, amplitude of a sine through 0 at start_s
  double sway_period_s = 10;
  double from_s = -std::numeric_limits<double>::infinity();
  double until_s = std::numeric_limits<double>::infinity();  // not there any more

  /// Throws std::invalid_argument that names the first value out of range.
  void check() const;

  bool is_there(double time_s) const { return time_s >= from_s && time_s < until_s; }
};

/// Where the plane has gone by this time, m (NED).
Eigen::Vector3d offset(const PlaneMotion& motion, double time_s);

/// A rectangle in the world with a picture on it. It is seen from its front (z < 0 of its Target
/// frame) only; from behind it is not there.
struct TexturedPlane {
  cv::Mat texture;      // 8-bit grey; outer edge to outer edge it covers the rectangle
  double width_m = 0;   // along x of Target
  double height_m = 0;  // along y of Target
  /// Where the rectangle's centre is; x along the picture's rows, y down its columns.
  Transform<frame::World, frame::Target> world_from_target;
  double opacity = 1;  // below 1 what is behind shines through: glass, or, black, a shadow
  PlaneMotion motion{};
};

/// Where the plane's centre and axes are at this time.
Transform<frame::World, frame::Target> pose(const TexturedPlane& plane, double time_s);

/// What there is to see.
struct Scene {
  std::vector<TexturedPlane> planes;  // back to front: a later plane hides the earlier ones
  double background_grey = 200;       // where no plane is, 0..255
  std::optional<std::size_t> target;  // the plane that is looked for; empty: the last one

  /// Throws std::invalid_argument when there is no such plane.
  const TexturedPlane& target_plane() const;

  /// Throws std::invalid_argument that names the first plane and what is wrong with it: a texture
  /// that is empty or not 8-bit grey, a size that is not positive, a pose that is no rotation.
  void check() const;
};

/// A target on a wall that faces south: x of Target east, y down, z north, its centre at the origin
/// of the world.
Transform<frame::World, frame::Target> world_from_wall();

/// The default scene's measures.
struct WallOptions {
  double poster_width_m = 2.0;
  double poster_height_m = 1.5;
  double wall_width_m = 24;
  double wall_height_m = 16;
  double ground_below_m = 6;  // of the poster's centre; the wall stands on it
  double ground_depth_m = 30;
  double wall_px_per_m = 100;
  std::uint64_t seed = 1;

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// A facade at north 0 that faces south, with this poster centred at the origin of the world (the
/// last plane of the scene), and the ground in front of it.
Scene wall_scene(const cv::Mat& poster, const WallOptions& options = {});

}  // namespace kestrel
