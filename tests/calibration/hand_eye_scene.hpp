#pragma once

#include <vector>

#include "kestrel/calibration/hand_eye_stations.hpp"
#include "kestrel/geometry/rotation.hpp"

#include "support/random.hpp"

/// A vehicle that is held in many attitudes before a target, and the noise of what is measured.
namespace kestrel::test {

struct HandEyeNoise {
  double attitude_rad = 0;
  double pose_rad = 0;
  double pose_m = 0;
  double position_m = 0;
};

struct HandEyeScene {
  Mount body_from_camera;
  Eigen::Vector3d largest_turn_rad{0.35, 0.35, 0.35};  // roll, pitch, yaw
  int stations = 12;
  HandEyeNoise noise;
  enum class Positions { Known, Unknown } positions = Positions::Known;
};

inline Eigen::Vector3d normal3(Random& random, double size) {
  return {size * random.normal(), size * random.normal(), size * random.normal()};
}

inline std::vector<HandEyeStation> stations_of(const HandEyeScene& scene, Random& random) {
  using WorldFromBody = Transform<frame::World, frame::Body>;
  // The target stands about where the camera of the level vehicle looks, 2 m away.
  const WorldFromBody level{};
  const auto world_from_target =
      level * scene.body_from_camera *
      TargetPose{rotation_from_vector({0.2, -0.1, 0.15}), Eigen::Vector3d(0.1, -0.1, 2)};
  std::vector<HandEyeStation> all;
  for (int i = 0; i < scene.stations; ++i) {
    HandEyeStation s;
    s.stamp_s = i;
    const Eigen::Vector3d& most = scene.largest_turn_rad;
    s.attitude = {random.uniform(-1, 1) * most.x(), random.uniform(-1, 1) * most.y(),
                  random.uniform(-1, 1) * most.z()};
    const WorldFromBody body{rotation_of(s.attitude), random.vector3(0.3)};
    s.camera_from_target = (body * scene.body_from_camera).inverse() * world_from_target;
    const Eigen::Vector3d off = normal3(random, scene.noise.attitude_rad);
    s.attitude = {s.attitude.roll + off.x(), s.attitude.pitch + off.y(), s.attitude.yaw + off.z()};
    s.camera_from_target.rotation *= rotation_from_vector(normal3(random, scene.noise.pose_rad));
    s.camera_from_target.translation += normal3(random, scene.noise.pose_m);
    if (scene.positions == HandEyeScene::Positions::Known)
      s.position_ned_m = body.translation + normal3(random, scene.noise.position_m);
    all.push_back(s);
  }
  return all;
}

}  // namespace kestrel::test
