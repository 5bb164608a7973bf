#include "helicopter_pilot.hpp"

#include "kestrel/geometry/rotation.hpp"

namespace kestrel {

HelicopterPilot::HelicopterPilot(const HelicopterSetup& setup, const LabClock& clock)
    : setup_(setup), timer_(clock), sight_(setup) {}

HelicopterLawAnswer HelicopterPilot::answer(const HelicopterLawInput& input) {
  HelicopterLawAnswer given =
      timer_.timed([&] { return helicopter_law(input, setup_.law, memory_); });
  memory_ = given.law.next;
  last_.refusal = given.refusal;
  last_.rank = given.law.rank;
  last_.condition = given.law.condition;
  last_.smallest_singular_value = given.law.smallest_singular_value;
  return given;
}

void HelicopterPilot::obey(const BodyTwist& twist, const HelicopterFrame& frame) {
  const HelicopterConditions& c = setup_.conditions;
  Eigen::Vector4d wanted = to_command(twist).vector();
  if (c.feed_forward) {
    const double yaw = frame.state.yaw + c.yaw_bias_rad;
    wanted.head<3>() +=
        rotation_from_rpy(0, 0, yaw).transpose() * setup_.scenario.target_velocity_m_s;
  }
  last_.wanted = VelocityCommand::from_vector(wanted);
  VelocityCommand command = last_.wanted;
  if (c.limits) {
    command = limited(last_.sent, last_.wanted, *c.limits, c.period_frames * kHelicopterFrame_s);
  }
  last_.saturated = command.vector() != last_.wanted.vector();
  last_.sent = command;
  servo_command_ = command;
  servo_s_ = frame.time_s;
}

void HelicopterPilot::do_without(double time_s) {
  const HelicopterConditions& c = setup_.conditions;
  last_.saturated = false;
  switch (c.reaction) {
    case LossReaction::Hold:
      last_.wanted = servo_command_;
      last_.sent = last_.wanted;
      return;
    case LossReaction::Hover:
      last_.wanted = VelocityCommand::hover();
      last_.sent = c.limits ? limited(last_.sent, last_.wanted, *c.limits, kHelicopterFrame_s)
                            : last_.wanted;
      last_.saturated = last_.sent.vector() != last_.wanted.vector();
      return;
    case LossReaction::Failsafe:
      last_.wanted = servo_s_ ? after_loss(servo_command_, time_s - *servo_s_, c.failsafe).command
                              : VelocityCommand::hover();
      last_.sent = last_.wanted;
      return;
  }
}

void HelicopterPilot::fly(const HelicopterFrame& frame) {
  sight_.look(frame);
  if (frame.step % setup_.conditions.period_frames == 0) {
    last_.rank = 0;
    last_.refusal = LawRefusal::None;
    const std::optional<HelicopterLawInput> input = sight_.told();
    last_.seen = input.has_value();
    if (input) {
      const HelicopterLawAnswer given = answer(*input);
      if (given.twist) return obey(*given.twist, frame);
    } else {
      memory_ = {};  // nothing is learned over a gap
    }
  }
  const bool blind = !last_.seen || last_.refusal != LawRefusal::None;
  if (blind) do_without(frame.time_s);
}

void HelicopterPilot::tell(HelicopterStep& step) const {
  step.wanted = last_.wanted;
  step.sent = last_.sent;
  step.seen = last_.seen;
  step.refusal = last_.refusal;
  step.saturated = last_.saturated;
  step.rank = last_.rank;
  step.condition = last_.condition;
  step.smallest_singular_value = last_.smallest_singular_value;
}

}  // namespace kestrel
