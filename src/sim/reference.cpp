#include "kestrel/sim/reference.hpp"

#include <cmath>
#include <stdexcept>

#include "kestrel/sim/render.hpp"

namespace kestrel {
namespace {

/// Pixels first .. first + count - 1 along one axis, and where their centre lies on the target.
struct Span {
  double first;
  double count;
  double centre_m;
};

/// Edges that miss a pixel's border by less than this, px, are rounding errors.
constexpr double kEdgeSlack = 1e-6;

/// Whole pixels of a side of length_m centred at principal_px, m_per_px wide each.
Span whole_pixels(double length_m, double m_per_px, double principal_px, int image_px) {
  const double half = length_m / m_per_px / 2;
  const double first = std::ceil(principal_px - half + 0.5 - kEdgeSlack);
  const double last = std::floor(principal_px + half - 0.5 + kEdgeSlack);
  if (first < 0 || last > image_px - 1) {
    throw std::invalid_argument(
        "the target does not fit into the picture at the goal's distance; move the goal away");
  }
  if (last - first + 1 < 16) {
    throw std::invalid_argument(
        "the target spans less than 16 px at the goal's distance; move the goal nearer");
  }
  return {first, last - first + 1, ((first + last) / 2 - principal_px) * m_per_px};
}

/// What there is up to the target: nothing that hides it or shades it.
Scene uncovered(const Scene& scene) {
  Scene open = scene;
  if (scene.target) open.planes.resize(*scene.target + 1);
  open.target.reset();
  open.planes.back().motion = {};
  return open;
}

}  // namespace

Reference goal_view(const Scene& scene, const Camera& camera, const TargetPose& goal) {
  const TexturedPlane& target = scene.target_plane();
  if (!(goal.translation.z() > 0) || !goal.translation.allFinite()) {
    throw std::invalid_argument("the goal must have the target in front of the camera");
  }
  CameraParameters pinhole = camera.parameters();
  pinhole.lens = Lens::Pinhole;
  const double distance_m = goal.translation.norm();
  const Span across =
      whole_pixels(target.width_m, distance_m / pinhole.px, pinhole.u0, pinhole.width);
  const Span down =
      whole_pixels(target.height_m, distance_m / pinhole.py, pinhole.v0, pinhole.height);
  Reference reference;
  const TargetPose in_front{Eigen::Matrix3d::Identity(), {0, 0, distance_m}};
  reference.image =
      render(uncovered(scene), Camera(pinhole), target.world_from_target * in_front.inverse());
  reference.box = {across.first, down.first, across.count, down.count};
  reference.width_m = across.count * distance_m / pinhole.px;
  reference.height_m = down.count * distance_m / pinhole.py;
  reference.target_from_template.translation << across.centre_m, down.centre_m, 0;
  return reference;
}

}  // namespace kestrel
