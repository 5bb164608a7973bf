#include "kestrel/ground/flight_scene.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "kestrel/geometry/rotation.hpp"

namespace kestrel {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

using LevelVehicle = Transform<frame::World, frame::Body>;

LevelVehicle level_from_vehicle(const VehiclePlace& place) {
  return {rotation_from_rpy(0, 0, place.yaw_rad), place.position_m};
}

/// The direction in the camera that a pixel shows, of length 1.
Vector3d ray(const Camera& camera, const Pixel& pixel) {
  const ImagePoint at = camera.to_image_point(pixel);
  return Vector3d(at.x, at.y, 1).normalized();
}

}  // namespace

LevelTarget level_from_target(const TargetPose& goal, const Mount& body_from_camera) {
  const Vector3d down =
      goal.rotation.transpose() * body_from_camera.rotation.transpose() * Vector3d::UnitZ();
  const auto level = [&](const Vector3d& v) { return Vector3d(v - v.dot(down) * down); };
  const Vector3d into = level(Vector3d::UnitZ());
  const bool stands = into.norm() >= std::sqrt(0.5);
  const Vector3d forward = (stands ? into : level(-Vector3d::UnitY())).normalized();
  LevelTarget level_frame;
  level_frame.rotation.row(0) = forward;
  level_frame.rotation.row(1) = down.cross(forward);
  level_frame.rotation.row(2) = down;
  return level_frame;
}

VehiclePlace vehicle_place(const TargetPose& camera_from_target, const Mount& body_from_camera,
                           const LevelTarget& level_from_target) {
  const LevelVehicle vehicle =
      level_from_target * camera_from_target.inverse() * body_from_camera.inverse();
  return {vehicle.translation, std::atan2(vehicle.rotation(1, 0), vehicle.rotation(0, 0))};
}

TargetPose seen_from(const VehiclePlace& place, const Mount& body_from_camera,
                     const LevelTarget& level_from_target) {
  return body_from_camera.inverse() * level_from_vehicle(place).inverse() * level_from_target;
}

bool has_whole_target_in_picture(const Task& task) {
  const CameraParameters& c = task.camera.parameters();
  if (c.width <= 0 || c.height <= 0) return true;
  const std::vector<Feature> desired = desired_features(task);
  return std::all_of(desired.begin(), desired.end(), [&](const Feature& feature) {
    const Pixel at = task.camera.to_pixel(feature.at);
    return feature.depth_m > 0 && at.u >= 0 && at.v >= 0 && at.u < c.width && at.v < c.height;
  });
}

FlightScene flight_scene(const Task& task, const std::optional<TargetPose>& seen,
                         const std::optional<Attitude>& attitude) {
  const LevelTarget level = level_from_target(task.goal, task.body_from_camera);
  FlightScene scene;
  const std::array<Vector3d, 4> corners = target_corners(task);
  for (std::size_t i = 0; i < corners.size(); ++i) scene.target_m[i] = level * corners[i];
  scene.goal = vehicle_place(task.goal, task.body_from_camera, level);
  if (!seen) return scene;
  scene.vehicle = vehicle_place(*seen, task.body_from_camera, level);
  const CameraParameters& c = task.camera.parameters();
  const Matrix3d level_from_camera = rotation_from_rpy(0, 0, scene.vehicle->yaw_rad) *
                                     level_from_body(attitude.value_or(Attitude{})) *
                                     task.body_from_camera.rotation;
  const double right = std::max(c.width, 1);
  const double bottom = std::max(c.height, 1);
  const std::array<Pixel, 4> ends{{{0, 0}, {right, 0}, {right, bottom}, {0, bottom}}};
  for (std::size_t i = 0; i < ends.size(); ++i) {
    scene.sight[i] = level_from_camera * ray(task.camera, ends[i]);
  }
  return scene;
}

std::optional<std::array<Pixel, 2>> horizon(const Camera& camera, const Mount& body_from_camera,
                                            const Attitude& attitude) {
  constexpr double kFarthest_px = 1e5;
  const Vector3d down =
      (level_from_body(attitude) * body_from_camera.rotation).transpose() * Vector3d::UnitZ();
  // Level directions are those with down . (K^-1 pixel) = 0: the line a u + b v + c = 0.
  const Vector3d line = camera.K().inverse().transpose() * down;
  const double a = line.x();
  const double b = line.y();
  const double c = line.z();
  const double right = camera.parameters().width;
  const double bottom = camera.parameters().height;
  std::array<Pixel, 2> ends;
  if (std::abs(a) <= std::abs(b)) {
    ends = {{{0, -c / b}, {right, -(a * right + c) / b}}};
  } else {
    ends = {{{-c / a, 0}, {-(b * bottom + c) / a, bottom}}};
  }
  const auto is_near = [](const Pixel& p) {
    return std::abs(p.u) <= kFarthest_px && std::abs(p.v) <= kFarthest_px;
  };
  if (!is_near(ends[0]) || !is_near(ends[1])) return std::nullopt;
  return ends;
}

}  // namespace kestrel
