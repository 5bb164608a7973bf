#pragma once

#include <deque>

#include "kestrel/io/run_log.hpp"
#include "kestrel/loop/decide.hpp"
#include "kestrel/sim/world.hpp"

#include "support/random.hpp"

namespace kestrel::test {

/// What is different in the world from what the task says.
struct Truth {
  Mount body_from_camera = forward_mount();
  double target_width_m = 1;  // square
  double noise_px = 0;
  int delay_frames = 0;  // from the image to the command
};

/// A target of 1 x 1 m, to be seen from 5 m straight in front.
inline Task square_task() {
  Task task{default_camera()};
  task.body_from_camera = forward_mount();
  task.target_width_m = 1;
  task.target_height_m = 1;
  task.goal.translation << 0, 0, 5;
  return task;
}

/// The log of a flight below the image: features from the true pose, the pose as the task's sizes
/// make it.
inline LogFile feature_flight(const Task& task, const Truth& truth, double duration_s,
                              double rate_hz = 30) {
  HelicopterState s = WorldOptions::default_start();
  s.yaw = -0.15;
  Random random("feature_flight");
  LogFile log;
  DecisionState memory;
  const double scale = task.target_width_m / truth.target_width_m;
  std::deque<VelocityCommand> queue(std::size_t(truth.delay_frames));
  for (int k = 0; k < int(duration_s * rate_hz); ++k) {
    const double t = k / rate_hz;
    TargetPose seen = (pose(s) * truth.body_from_camera).inverse() * world_from_wall();
    seen.translation *= scale;
    if (seen.translation.z() < 0.5) break;
    std::vector<Feature> corners = features(seen, target_corners(task));
    for (Feature& f : corners) {
      f.at.x += truth.noise_px / 600 * random.normal();
      f.at.y += truth.noise_px / 600 * random.normal();
    }
    const Decision decision = decide(corners, attitude(s), t, memory, task);
    memory = decision.next;
    LogRow row;
    row.frame = k;
    row.stamp_s = t;
    row.status = TrackStatus::Found;
    row.attitude = attitude(s);
    row.pose = LoggedPose{seen.translation, rotation_vector(seen.rotation), 0.1, false};
    if (decision.servo) {
      row.servo.emplace();
      for (std::size_t i = 0; i < 8; ++i)
        row.servo->error[i] = decision.servo->error[Eigen::Index(i)];
      row.servo->error_norm = decision.servo->error.norm();
      row.servo->condition = decision.servo->condition;
      row.servo->twist = decision.servo->twist;
    }
    row.decision = LoggedDecision{decision.state, decision.wanted, decision.command};
    log.rows.push_back(row);
    queue.push_back(decision.command);
    s = advanced(s, queue.front(), 1 / rate_hz);
    queue.pop_front();
  }
  return log;
}

}  // namespace kestrel::test
