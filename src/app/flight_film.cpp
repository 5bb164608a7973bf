#include "flight_film.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <Eigen/LU>

#include "kestrel/sim/visibility.hpp"

namespace kestrel::app {
namespace {

constexpr double kSmallest_px = 16;
constexpr double kLabelledShare = 0.5;

Pixel pixel_of(const Camera& camera, const TargetPose& camera_from_target,
               const Eigen::Vector3d& on_target) {
  const Eigen::Vector3d p = camera_from_target * on_target;
  return camera.to_pixel({p.x() / p.z(), p.y() / p.z()});
}

/// Where a pixel's ray meets the target's plane, m.
Eigen::Vector3d on_target(const Camera& camera, const TargetPose& camera_from_target,
                          const Pixel& at) {
  const ImagePoint ray = camera.to_image_point(at);
  const auto target_from_camera = camera_from_target.inverse();
  const Eigen::Vector3d& eye = target_from_camera.translation;
  const Eigen::Vector3d way = target_from_camera.rotation * Eigen::Vector3d(ray.x, ray.y, 1);
  return eye - eye.z() / way.z() * way;
}

/// Whole pixels within the quadrilateral (top left, top right, bottom right, bottom left, as it
/// stands more or less upright) and the image.
PixelBox upright_box(const std::array<Pixel, 4>& q, const CameraParameters& camera) {
  const double left = std::ceil(std::max({q[0].u, q[3].u, 0.0}));
  const double right = std::floor(std::min({q[1].u, q[2].u, camera.width - 1.0}));
  const double top = std::ceil(std::max({q[0].v, q[1].v, 0.0}));
  const double bottom = std::floor(std::min({q[2].v, q[3].v, camera.height - 1.0}));
  return {left, top, right - left + 1, bottom - top + 1};
}

/// Pixels of the undistorted image from points of the target's plane (x, y, 1), m.
Eigen::Matrix3d image_from_plane(const Camera& camera, const TargetPose& pose) {
  Eigen::Matrix3d ray_from_plane;
  ray_from_plane << pose.rotation.leftCols<2>(), pose.translation;
  return camera.K() * ray_from_plane;
}

Homography between(const Camera& camera, const TargetPose& now, const TargetPose& first) {
  const Eigen::Matrix3d H =
      image_from_plane(camera, now) * image_from_plane(camera, first).inverse();
  return {H / H(2, 2)};
}

}  // namespace

FlightFilm::FlightFilm(std::filesystem::path folder, std::string name, const Scene& scene,
                       const WorldOptions& options)
    : folder_(std::move(folder)),
      name_(std::move(name)),
      scene_(scene),
      camera_(options.camera),
      rate_hz_(options.rate_hz) {
  require_new_sequence(folder_, name_);
}

void FlightFilm::begin(const TargetPose& camera_from_target) {
  const TexturedPlane& target = scene_.target_plane();
  const double x = target.width_m / 2;
  const double y = target.height_m / 2;
  const std::array<Eigen::Vector3d, 4> edges = {{{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}}};
  std::array<Pixel, 4> outline;
  std::transform(edges.begin(), edges.end(), outline.begin(), [&](const Eigen::Vector3d& p) {
    return pixel_of(camera_, camera_from_target, p);
  });
  const PixelBox box = upright_box(outline, camera_.parameters());
  if (!(box.width >= kSmallest_px && box.height >= kSmallest_px)) {
    throw std::runtime_error(
        "--record: no upright rectangle of 16 px lies within the target in the first frame; start "
        "nearer, with the target in view and upright");
  }
  first_ = camera_from_target;
  const std::array<Pixel, 4> corners = template_corners(box.width, box.height);
  std::transform(corners.begin(), corners.end(), on_target_.begin(), [&](const Pixel& p) {
    return on_target(camera_, first_, {box.u + p.u, box.v + p.v});
  });
  writer_.emplace(folder_, name_,
                  SequenceHead{rate_hz_, box, camera_, "simulated flight: " + name_,
                               "rendered by kestrel simulate --record; the truth is that of the "
                               "simulation, at each frame's stamp",
                               "that of the pictures in the scene"});
}

void FlightFilm::record(const Frame& frame, const World& world) {
  const TargetPose pose = world.camera_from_target();
  if (!writer_) begin(pose);
  RecordedFrame recorded;
  recorded.index = frame.index;
  recorded.stamp_s = frame.stamp_s;
  recorded.gray = frame.gray;
  recorded.camera_from_target = pose;
  recorded.image_from_first = between(camera_, pose, first_);
  std::transform(on_target_.begin(), on_target_.end(), recorded.corners.begin(),
                 [&](const Eigen::Vector3d& p) { return pixel_of(camera_, pose, p); });
  const double share = visible_share(scene_, camera_, {frame.stamp_s, world.world_from_camera()});
  recorded.is_labelled = share >= kLabelledShare;
  writer_->write(recorded);
}

}  // namespace kestrel::app
