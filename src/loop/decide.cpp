#include "kestrel/loop/decide.hpp"

#include <cmath>
#include <utility>

#include "kestrel/vehicle/limits.hpp"

namespace kestrel {
namespace {

bool is_finite(const Attitude& a) {
  return std::isfinite(a.roll) && std::isfinite(a.pitch) && std::isfinite(a.yaw);
}

/// The camera on the levelled helicopter: it keeps its axes in the body, but its place is that of
/// the camera on the tilted one.
Mount levelled(const Mount& body_from_camera, const Attitude& attitude) {
  return {body_from_camera.rotation, level_from_body(attitude) * body_from_camera.translation};
}

/// Exact zeros, and nothing remembered that could be resumed.
Decision hovering(const std::optional<double>& stamp_s) {
  Decision decision;
  decision.next.stamp_s = stamp_s;
  return decision;
}

Decision without_answer(double stamp_s, const DecisionState& state, const Task& task,
                        LawRefusal refusal) {
  Decision decision = hovering(stamp_s);
  decision.refusal = refusal;
  if (!state.seen_stamp_s) return decision;
  const FailsafeCommand failsafe =
      after_loss(state.servo_command, stamp_s - *state.seen_stamp_s, task.loss);
  if (failsafe.state == CommandState::Hover) return decision;
  decision.wanted = failsafe.command;
  decision.command = failsafe.command;
  decision.state = failsafe.state;
  decision.next = state;
  decision.next.sent = failsafe.command;
  decision.next.stamp_s = stamp_s;
  return decision;
}

VelocityCommand within_limits(const VelocityCommand& wanted, double stamp_s,
                              const DecisionState& state, const Task& task) {
  const bool known = state.stamp_s && stamp_s - *state.stamp_s <= task.loss.hover_after_s;
  if (!known) return VelocityCommand::hover();
  return limited(state.sent, wanted, task.limits, stamp_s - *state.stamp_s);
}

/// The motion of the camera since the previous frame, had the helicopter flown what was sent; empty
/// when the target was not servoed on in that frame.
std::optional<Vector6d> camera_motion(double stamp_s, const DecisionState& state,
                                      const Mount& level_from_camera) {
  if (!state.stamp_s || state.seen_stamp_s != state.stamp_s) return std::nullopt;
  const Eigen::Vector4d sent = state.sent.vector();
  const BodyTwist body{sent.head<3>(), {0, 0, sent[3]}};
  const CameraTwist camera = level_from_camera.inverse() * body;
  return Vector6d(camera.vector() * (stamp_s - *state.stamp_s));
}

LawAnswer answer_of_law(const std::vector<Feature>& level, const Mount& level_from_camera,
                        double stamp_s, const DecisionState& state, const Task& task) {
  LawInput input = law_input(level, task);
  input.camera_motion = camera_motion(stamp_s, state, level_from_camera);
  input.time_s = stamp_s - state.law_since_s.value_or(stamp_s);
  return law_on_body(std::move(input), level_from_camera, task.servo, state.law);
}

}  // namespace

Decision decide(const std::vector<Feature>& measured, const std::optional<Attitude>& attitude,
                double stamp_s, const DecisionState& state, const Task& task) {
  if (!std::isfinite(stamp_s)) return hovering(std::nullopt);
  if (state.stamp_s && !(stamp_s > *state.stamp_s)) return hovering(std::nullopt);
  if (!is_finite(measured) || (attitude && !is_finite(*attitude))) return hovering(stamp_s);

  std::vector<Feature> level = measured;
  Mount mount = task.body_from_camera;
  if (attitude) {
    level = turned(measured, level_camera_from_camera(mount.rotation, *attitude));
    mount = levelled(mount, *attitude);
  }
  const LawAnswer answer = answer_of_law(level, mount, stamp_s, state, task);
  if (!answer.twist)
    return without_answer(stamp_s, state, task, level.empty() ? LawRefusal::None : answer.refusal);
  Decision decision;
  decision.servo = Servo{*answer.twist, answer.error, answer.condition};
  decision.body_twist = mount * decision.servo->twist;
  decision.wanted = to_command(decision.body_twist);
  decision.command = within_limits(decision.wanted, stamp_s, state, task);
  decision.state = CommandState::Servo;
  decision.next = {decision.command, stamp_s,     decision.command,
                   stamp_s,          answer.next, state.law_since_s.value_or(stamp_s)};
  return decision;
}

}  // namespace kestrel
