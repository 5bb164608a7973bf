#include "kestrel/lab/helicopter_sight.hpp"

#include <algorithm>

#include "kestrel/geometry/point_pose.hpp"
#include "kestrel/geometry/rotation.hpp"
#include "kestrel/geometry/twist.hpp"

#include "law_needs.hpp"

namespace kestrel {
namespace {

bool is_levelled(HelicopterVariant variant) {
  return variant != HelicopterVariant::Raw4 && variant != HelicopterVariant::Drop6;
}

/// Image times are compared to a millionth of a frame: 60 / 30 s is 2 s.
bool is_lost(const HelicopterConditions& c, double time_s) {
  constexpr double kSlack_s = 1e-6 * kHelicopterFrame_s;
  if (!c.loss) return false;
  const double since_s = time_s - c.loss->from_s + kSlack_s;
  return since_s >= 0 && since_s < c.loss->for_s;
}

}  // namespace

HelicopterFrame frame_at(const HelicopterSetup& setup, int step, const HelicopterState& state) {
  HelicopterFrame frame;
  frame.step = step;
  frame.time_s = step * kHelicopterFrame_s;
  frame.state = state;
  frame.world_from_camera = pose(state) * setup.scenario.body_from_camera;
  Transform<kestrel::frame::World, kestrel::frame::Target> world_from_target =
      setup.scenario.world_from_target;
  world_from_target.translation += frame.time_s * setup.scenario.target_velocity_m_s;
  frame.camera_from_target = frame.world_from_camera.inverse() * world_from_target;
  frame.points = seen_points(frame.camera_from_target, setup.scenario.points_m);
  return frame;
}

Transform<frame::World, frame::Camera> level_camera(const HelicopterSetup& setup,
                                                    const HelicopterFrame& frame) {
  return {rotation_from_rpy(0, 0, frame.state.yaw) * setup.scenario.body_from_camera.rotation,
          frame.world_from_camera.translation};
}

HelicopterSight::HelicopterSight(const HelicopterSetup& setup)
    : setup_(setup),
      noise_(setup.conditions.seed, setup.conditions.noise_px),
      desired_(seen_points(setup.scenario.goal, setup.scenario.points_m)),
      goal_heading_rad_(goal_heading(setup.scenario)),
      images_(std::size_t(setup.conditions.delay_frames) + 1) {
  for (Feature& f : desired_) f.depth_m *= setup.conditions.depth_factor;
}

void HelicopterSight::look(const HelicopterFrame& frame) {
  ++step_;
  Image& image = images_[std::size_t(step_) % images_.size()];
  image.frame = frame;
  image.measured = frame.points;
  image.seen = !is_lost(setup_.conditions, frame.time_s);
  for (Feature& f : image.measured) {
    const Pixel noise = noise_.next();
    f.at.x += noise.u / setup_.camera.focal_px;
    f.at.y += noise.v / setup_.camera.focal_px;
    f.depth_m *= setup_.conditions.depth_factor;
  }
}

Transform<frame::World, frame::Camera> HelicopterSight::looked_through(
    const HelicopterFrame& frame) const {
  return is_levelled(setup_.law.variant) ? level_camera(setup_, frame) : frame.world_from_camera;
}

void HelicopterSight::add_pose(LawInput& input, const Image& image) const {
  if (!needs_pose(setup_.law.law.law)) return;
  std::vector<ImagePoint> seen;
  for (const Feature& f : image.measured) seen.push_back(f.at);
  std::optional<TargetPose> found =
      point_pose(setup_.scenario.points_m, seen, image.frame.camera_from_target);
  if (!found) return;
  TargetPose goal = setup_.scenario.goal;
  found->translation *= setup_.conditions.depth_factor;
  goal.translation *= setup_.conditions.depth_factor;
  const GoalFromCamera motion = goal * found->inverse();
  input.camera_from_target = found;
  input.goal_from_target = goal;
  input.goal_from_camera = Displacement{motion.rotation, motion.translation};
}

std::optional<HelicopterLawInput> HelicopterSight::told() {
  const HelicopterConditions& c = setup_.conditions;
  const Image& used = image(std::max(0, step_ - c.delay_frames));
  if (!used.seen) {
    told_.reset();
    return std::nullopt;
  }
  HelicopterLawInput input;
  input.camera.measured = used.measured;
  input.camera.desired = desired_;
  input.camera.time_s = step_ * kHelicopterFrame_s;
  add_pose(input.camera, used);
  const Transform<frame::World, frame::Camera> then = looked_through(used.frame);
  if (told_ && told_->step < used.frame.step) {
    const CameraMotion moved = looked_through(*told_).inverse() * then;
    input.camera.camera_motion = logarithm(Displacement{moved.rotation, moved.translation});
  }
  told_ = used.frame;
  input.body_from_camera = setup_.scenario.body_from_camera;
  const HelicopterState& s = used.frame.state;
  input.attitude = {s.roll + c.roll_bias_rad, s.pitch + c.pitch_bias_rad, s.yaw + c.yaw_bias_rad};
  const HelicopterFrame& now = image(step_).frame;
  input.heading_rad = now.state.yaw + c.yaw_bias_rad;
  input.goal_heading_rad = goal_heading_rad_;
  if (c.predicted) input.now_from_then = looked_through(now).inverse() * then;
  return input;
}

}  // namespace kestrel
