#include "kestrel/loop/mount_response.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "kestrel/geometry/rotation.hpp"

namespace kestrel {
namespace {

constexpr double kStep = 0.01;           // of the distance, or rad: small enough to be linear
constexpr double kSmallestEffort = 0.1;  // below it the change stays
constexpr double kNamedShare = 0.25;     // of the largest velocity

/// Where the target would be for the change, the camera staying.
TargetPose changed(const TargetPose& goal, ImageChange change) {
  const double step_m = kStep * goal.translation.norm();
  TargetPose pose = goal;
  switch (change) {
    case ImageChange::Right:
      pose.translation.x() += step_m;
      break;
    case ImageChange::Lower:
      pose.translation.y() += step_m;
      break;
    case ImageChange::Larger:
      pose.translation -= kStep * goal.translation;
      break;
    case ImageChange::Clockwise:  // about the view to the target's centre; x right, y down
      pose.rotation = rotation_from_vector(kStep * goal.translation.normalized()) * goal.rotation;
      break;
  }
  return pose;
}

MountResponse response_to(ImageChange change, const Task& task) {
  MountResponse response;
  response.change = change;
  response.distance_m = task.goal.translation.norm();
  ServoOptions law = task.servo;
  law.far_gain_per_s.reset();
  law.smooth_start_per_s = 0;  // its first answer is zero
  const TargetPose seen = changed(task.goal, change);
  const LawInput input = law_input(features(seen, target_corners(task)), task);
  const LawAnswer answer = law_on_body(input, task.body_from_camera, law);
  response.refusal = answer.refusal;
  if (!answer.twist) return response;
  response.command = to_command(task.body_from_camera * *answer.twist);
  Eigen::Vector4d velocities = response.command.vector();
  velocities[3] *= response.distance_m;
  response.effort = velocities.norm() / (law.gain_per_s * kStep * response.distance_m);
  return response;
}

const char* words(ImageChange change) {
  switch (change) {
    case ImageChange::Right:
      return "target to the right in the image";
    case ImageChange::Lower:
      return "target lower in the image";
    case ImageChange::Larger:
      return "target larger in the image";
    case ImageChange::Clockwise:
      return "target turned clockwise in the image";
  }
  return "target elsewhere";
}

struct Motion {
  double size = 0;  // m/s, at the target's distance
  std::string words;
};

/// The four velocities, the largest first.
std::vector<Motion> motions(const MountResponse& r) {
  const VelocityCommand& c = r.command;
  const auto one = [](double v, const char* forth, const char* back) {
    return Motion{std::abs(v), v < 0 ? back : forth};
  };
  std::vector<Motion> all = {
      one(c.forward_m_s, "moves forward", "moves backward"),
      one(c.right_m_s, "moves right", "moves left"), one(c.down_m_s, "moves down", "moves up"),
      one(c.yaw_rate_rad_s * r.distance_m, "turns its nose right", "turns its nose left")};
  std::stable_sort(all.begin(), all.end(),
                   [](const Motion& a, const Motion& b) { return a.size > b.size; });
  return all;
}

}  // namespace

std::vector<MountResponse> mount_responses(const Task& task) {
  std::vector<MountResponse> all;
  for (const ImageChange change :
       {ImageChange::Right, ImageChange::Lower, ImageChange::Larger, ImageChange::Clockwise}) {
    all.push_back(response_to(change, task));
  }
  return all;
}

Task task_with_mount(const Mount& body_from_camera) {
  Task task{Camera({600, 600, 319.5, 239.5, 640, 480})};
  task.body_from_camera = body_from_camera;
  task.target_width_m = 1;
  task.target_height_m = 1;
  task.goal.translation = {0, 0, 5};
  return task;
}

std::string describe(const MountResponse& response) {
  std::string text = std::string(words(response.change)) + " -> ";
  if (response.refusal != LawRefusal::None)
    return text + "no command: the law has no answer (" + name(response.refusal) + ")";
  if (response.effort < kSmallestEffort)
    return text + "the vehicle stays: no velocity that the law may use undoes it";
  const std::vector<Motion> all = motions(response);
  std::string what;
  for (const Motion& motion : all) {
    if (motion.size < kNamedShare * all.front().size) continue;
    what += (what.empty() ? "" : " and ") + motion.words;
  }
  return text + "the vehicle " + what;
}

}  // namespace kestrel
