#pragma once

#include <functional>
#include <vector>

#include "kestrel/geometry/rotation.hpp"
#include "kestrel/geometry/twist.hpp"
#include "kestrel/servo/control_law.hpp"

#include "servo/oracle.hpp"

/// A camera that flies as the law says, in twenty lines, and the start poses of the benchmark.
namespace kestrel::test {

inline const std::array<Eigen::Vector3d, 4> kBenchSquare = square(0.1);
inline const TargetPose kBenchGoal = pose_of({0, 0, 0.75}, {0, 0, 0});

Displacement displacement(const Eigen::Vector3d& t, const Eigen::Vector3d& theta_u_deg);

/// The target seen from a camera that stands there in the goal's camera (cdMc).
TargetPose seen_from(const Displacement& goal_from_camera);

TargetPose turned_about_axis(double deg);

inline const TargetPose kS0 = pose_of({.15, -.1, 1.0}, {10, -10, 50});
inline const TargetPose kS1 = seen_from(displacement({.05, -.04, -.10}, {3, -2, 5}));
inline const TargetPose kS3 = turned_about_axis(90);
inline const TargetPose kS5 = turned_about_axis(160);
inline const TargetPose kS8 = seen_from(displacement({.5, -.3, -.75}, {0, 0, 0}));

/// All a law may want to know when the target is there, without noise.
LawInput input_at(const TargetPose& pose);

LawOptions unit_options(Law law);

Vector6d twist_at(const TargetPose& pose, Law law);

/// One moment of a flight, before the twist is flown.
struct Moment {
  TargetPose pose;
  LawInput input;
  LawAnswer answer;
};

/// Steps at dt_s until a point is nearer than 5 cm, or there is no twist; the law is told by how
/// much the camera moved. Every step is shown to look().
TargetPose fly(TargetPose pose, const LawOptions& options, int steps, double dt_s,
               const std::function<void(const Moment&)>& look = {});

double error_at(const TargetPose& pose);

}  // namespace kestrel::test
