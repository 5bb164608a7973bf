#include "kestrel/loop/decide.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kestrel/servo/latency.hpp"
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

/// What is known of the vehicle when the frame was captured.
struct KnownMotion {
  const std::optional<Attitude>& attitude;
  const std::optional<Eigen::Vector3d>& velocity_ned_m_s;
};

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

/// The motion at the frame's stamp, with the velocity measured there if there is one; at rest after
/// a gap as long as the one after which the law starts anew.
DeadReckoning motion_at(double stamp_s, const DecisionState& state, const KnownMotion& known,
                        const Task& task) {
  DeadReckoning motion;
  motion.stamp_s = stamp_s;
  const double gone_s = stamp_s - state.motion.stamp_s;
  if (state.stamp_s && gone_s >= 0 && gone_s <= task.loss.hover_after_s) {
    motion = advanced(state.motion, stamp_s, task.timing.response);
  }
  if (!known.attitude || !known.velocity_ned_m_s) return motion;
  const Eigen::Vector3d& v = *known.velocity_ned_m_s;
  const double c = std::cos(known.attitude->yaw);
  const double s = std::sin(known.attitude->yaw);
  motion.velocity = {c * v.x() + s * v.y(), c * v.y() - s * v.x(), v.z(),
                     motion.velocity.yaw_rate_rad_s};
  return motion;
}

/// Over how long the features are predicted; 0: not at all.
double predicted_s(const DecisionState& state, const KnownMotion& known, const Task& task) {
  const Prediction predict = task.timing.predict;
  const bool is_measured = known.attitude && known.velocity_ned_m_s;
  const bool wanted =
      predict == Prediction::Commanded || (predict == Prediction::Measured && is_measured);
  return wanted ? latency_s(state.timing, task.timing).value_or(0) : 0;
}

/// What the levelled camera sees and how it is mounted on the levelled body.
struct View {
  std::vector<Feature> features;
  Mount mount;
};

View levelled_view(const std::vector<Feature>& measured, const std::optional<Attitude>& attitude,
                   const Task& task) {
  if (!attitude) return {measured, task.body_from_camera};
  return {turned(measured, level_camera_from_camera(task.body_from_camera.rotation, *attitude)),
          levelled(task.body_from_camera, *attitude)};
}

/// The features after this motion; as they are when it puts one behind the camera.
std::vector<Feature> over_latency(const View& view, const BodyMotion& now_from_then) {
  const CameraMotion camera = view.mount.inverse() * now_from_then * view.mount;
  std::vector<Feature> moved = predicted(view.features, camera);
  const bool is_seen =
      is_finite(moved) &&
      std::all_of(moved.begin(), moved.end(), [](const Feature& f) { return f.depth_m > 0; });
  return is_seen ? moved : view.features;
}

/// The law's options within what the timing allows.
ServoOptions within_timing(ServoOptions servo, const std::optional<double>& largest_per_s) {
  if (!largest_per_s) return servo;
  servo.gain_per_s = std::min(servo.gain_per_s, *largest_per_s);
  if (servo.far_gain_per_s)
    servo.far_gain_per_s = std::min(*servo.far_gain_per_s, servo.gain_per_s);
  return servo;
}

LawAnswer answer_of_law(const View& view, double stamp_s, const DecisionState& state,
                        const Task& task, const ServoOptions& servo) {
  LawInput input = law_input(view.features, task);
  input.camera_motion = camera_motion(stamp_s, state, view.mount);
  input.time_s = stamp_s - state.law_since_s.value_or(stamp_s);
  return law_on_body(std::move(input), view.mount, servo, state.law);
}

/// The decision of a frame whose numbers are sound; timing and motion are those of the frame.
Decision decided(const std::vector<Feature>& measured, const KnownMotion& known, double stamp_s,
                 const DecisionState& state, const Task& task) {
  View view = levelled_view(measured, known.attitude, task);
  const double ahead_s = measured.empty() ? 0 : predicted_s(state, known, task);
  if (ahead_s > 0) {
    view.features = over_latency(view, travelled(state.motion, ahead_s, task.timing.response));
  }
  const ServoOptions servo =
      within_timing(task.servo, largest_gain_per_s(state.timing, task.timing));
  const LawAnswer answer = answer_of_law(view, stamp_s, state, task, servo);
  if (!answer.twist)
    return without_answer(stamp_s, state, task,
                          measured.empty() ? LawRefusal::None : answer.refusal);
  Decision decision;
  decision.servo = Servo{*answer.twist, answer.error, answer.condition};
  decision.body_twist = view.mount * decision.servo->twist;
  decision.wanted = to_command(decision.body_twist);
  decision.command = within_limits(decision.wanted, stamp_s, state, task);
  decision.state = CommandState::Servo;
  decision.predicted_s = ahead_s;
  if (servo.gain_per_s < task.servo.gain_per_s) decision.gain_per_s = servo.gain_per_s;
  decision.next = {decision.command, stamp_s,     decision.command,
                   stamp_s,          answer.next, state.law_since_s.value_or(stamp_s)};
  return decision;
}

bool is_sound(const std::vector<Feature>& measured, const KnownMotion& known) {
  return is_finite(measured) && (!known.attitude || is_finite(*known.attitude)) &&
         (!known.velocity_ned_m_s || known.velocity_ned_m_s->allFinite());
}

/// Timing outlives whatever a frame brings.
Decision with_timing(Decision decision, const LoopTiming& timing) {
  decision.next.timing = timing;
  return decision;
}

}  // namespace

Decision decide(const std::vector<Feature>& measured, const std::optional<Attitude>& attitude,
                double stamp_s, const DecisionState& state, const Task& task,
                const std::optional<Eigen::Vector3d>& velocity_ned_m_s) {
  const KnownMotion known{attitude, velocity_ned_m_s};
  if (!std::isfinite(stamp_s)) return with_timing(hovering(std::nullopt), state.timing);
  if (state.stamp_s && !(stamp_s > *state.stamp_s)) {
    return with_timing(hovering(std::nullopt), state.timing);
  }
  if (!is_sound(measured, known)) return with_timing(hovering(stamp_s), state.timing);
  DecisionState now = state;
  if (state.stamp_s) now.timing = with_period(state.timing, stamp_s - *state.stamp_s);
  now.motion = motion_at(stamp_s, state, known, task);
  Decision decision = decided(measured, known, stamp_s, now, task);
  decision.next.timing = now.timing;
  const double obeyed_s = stamp_s + latency_s(now.timing, task.timing).value_or(0);
  decision.next.motion = told(std::move(now.motion), {obeyed_s, decision.command});
  return decision;
}

}  // namespace kestrel
