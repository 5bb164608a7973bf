#pragma once

#include <algorithm>
#include <cmath>
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

inline Displacement displacement(const Eigen::Vector3d& t, const Eigen::Vector3d& theta_u_deg) {
  return {rotation_from_vector(theta_u_deg * M_PI / 180), t};
}

/// The target seen from a camera that stands there in the goal's camera (cdMc).
inline TargetPose seen_from(const Displacement& goal_from_camera) {
  const Transform<frame::Camera, frame::Camera> cdMc{goal_from_camera.rotation,
                                                     goal_from_camera.translation};
  return cdMc.inverse() * kBenchGoal;
}

inline TargetPose turned_about_axis(double deg) {
  return seen_from(displacement({0, 0, 0}, {0, 0, deg}));
}

inline const TargetPose kS0 = pose_of({.15, -.1, 1.0}, {10, -10, 50});
inline const TargetPose kS1 = seen_from(displacement({.05, -.04, -.10}, {3, -2, 5}));
inline const TargetPose kS3 = turned_about_axis(90);
inline const TargetPose kS5 = turned_about_axis(160);
inline const TargetPose kS8 = seen_from(displacement({.5, -.3, -.75}, {0, 0, 0}));

/// All a law may want to know when the target is there, without noise.
inline LawInput input_at(const TargetPose& pose) {
  LawInput input;
  input.measured = features(pose, kBenchSquare);
  input.desired = features(kBenchGoal, kBenchSquare);
  const auto cdMc = kBenchGoal * pose.inverse();
  input.goal_from_camera = Displacement{cdMc.rotation, cdMc.translation};
  input.camera_from_target = pose;
  input.goal_from_target = kBenchGoal;
  const auto cMcd = cdMc.inverse();  // H = R + t n^T / d, the plane at Z* = 0.75 facing the goal
  input.camera_from_goal_homography =
      cMcd.rotation + cMcd.translation * Eigen::RowVector3d(0, 0, 1) / 0.75;
  return input;
}

inline LawOptions unit_options(Law law) {
  LawOptions options;
  options.law = law;
  options.gain = LawGain::constant(1);
  options.max_condition = std::numeric_limits<double>::infinity();
  return options;
}

inline Vector6d twist_at(const TargetPose& pose, Law law) {
  const LawAnswer answer = control_law(input_at(pose), unit_options(law));
  return answer.twist ? answer.twist->vector() : Vector6d::Constant(NAN);
}

/// One moment of a flight, before the twist is flown.
struct Moment {
  TargetPose pose;
  LawInput input;
  LawAnswer answer;
};

/// Steps at dt_s until a point is nearer than 5 cm, or there is no twist; the law is told by how
/// much the camera moved. Every step is shown to look().
inline TargetPose fly(TargetPose pose, const LawOptions& options, int steps, double dt_s,
                      const std::function<void(const Moment&)>& look = {}) {
  LawState state;
  std::optional<Vector6d> motion;
  for (int k = 0; k < steps; ++k) {
    LawInput input = input_at(pose);
    input.camera_motion = motion;
    input.time_s = k * dt_s;
    if (std::any_of(input.measured.begin(), input.measured.end(),
                    [](const Feature& f) { return f.depth_m <= 0.05; })) {
      break;
    }
    const LawAnswer answer = control_law(input, options, state);
    if (look) look({pose, input, answer});
    if (!answer.twist) break;
    state = answer.next;
    motion = answer.twist->vector() * dt_s;
    pose = moved(pose.inverse(), *answer.twist, dt_s).inverse();
  }
  return pose;
}

inline double error_at(const TargetPose& pose) {
  return (stacked(features(pose, kBenchSquare)) - stacked(features(kBenchGoal, kBenchSquare)))
      .norm();
}

}  // namespace kestrel::test
