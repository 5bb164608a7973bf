#include "servo/law_bench.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kestrel::test {

Displacement displacement(const Eigen::Vector3d& t, const Eigen::Vector3d& theta_u_deg) {
  return {rotation_from_vector(theta_u_deg * M_PI / 180), t};
}

TargetPose seen_from(const Displacement& goal_from_camera) {
  const Transform<frame::Camera, frame::Camera> cdMc{goal_from_camera.rotation,
                                                     goal_from_camera.translation};
  return cdMc.inverse() * kBenchGoal;
}

TargetPose turned_about_axis(double deg) { return seen_from(displacement({0, 0, 0}, {0, 0, deg})); }

LawInput input_at(const TargetPose& pose) {
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

LawOptions unit_options(Law law) {
  LawOptions options;
  options.law = law;
  options.gain = LawGain::constant(1);
  options.max_condition = std::numeric_limits<double>::infinity();
  return options;
}

Vector6d twist_at(const TargetPose& pose, Law law) {
  const LawAnswer answer = control_law(input_at(pose), unit_options(law));
  return answer.twist ? answer.twist->vector() : Vector6d::Constant(NAN);
}

TargetPose fly(TargetPose pose, const LawOptions& options, int steps, double dt_s,
               const std::function<void(const Moment&)>& look) {
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

double error_at(const TargetPose& pose) {
  return (stacked(features(pose, kBenchSquare)) - stacked(features(kBenchGoal, kBenchSquare)))
      .norm();
}

}  // namespace kestrel::test
