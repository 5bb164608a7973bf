#pragma once

#include <cmath>

#include "kestrel/geometry/rotation.hpp"

#include "lab/lab_setup.hpp"
#include "support/random.hpp"

namespace kestrel::test {

/// Any world: random points, poses and conditions, sometimes odd ones.
inline CameraSetup any_setup(Random& random, Law law) {
  CameraSetup setup = benchmark_setup("S0_tutorial", law, 40);
  const int points = random.integer(1, 6);
  setup.scenario.points_m.clear();
  for (int i = 0; i < points; ++i) {
    Eigen::Vector3d point = random.vector3(.3);
    if (random.integer(0, 3) > 0) point.z() = 0;
    if (random.integer(0, 9) == 0) point.y() = 0;
    setup.scenario.points_m.push_back(point);
  }
  const auto any_pose = [&] {
    return TargetPose{rotation_from_vector(random.rotation_vector(M_PI)),
                      random.vector3(1) + Eigen::Vector3d(0, 0, 1)};
  };
  setup.scenario.goal = any_pose();
  if (random.integer(0, 5) > 0) setup.scenario.start = any_pose();
  if (random.integer(0, 9) == 0) setup.scenario.start = setup.scenario.goal;
  Conditions& c = setup.conditions;
  c.gain_per_s = std::pow(10, random.uniform(-2, 3));
  c.depth_factor = std::pow(10, random.uniform(-3, 3));
  c.focal_factor = random.uniform(.5, 2);
  c.noise_px = random.integer(0, 1) * random.uniform(0, 50);
  c.delay_frames = random.integer(0, 5);
  if (random.integer(0, 1) == 0) c.desired = Conditions::Desired::Model;
  if (random.integer(0, 1) == 0) c.limits.emplace();
  return setup;
}

}  // namespace kestrel::test
