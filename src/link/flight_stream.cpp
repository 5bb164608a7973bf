#include "kestrel/link/flight_stream.hpp"

#include <algorithm>

#include "kestrel/link/command_guard.hpp"

namespace kestrel {
namespace {

VelocityCommand as_floats(const VelocityCommand& c) {
  return VelocityCommand::from_vector(c.vector().cast<float>().cast<double>());
}

}  // namespace

bool is_hover(const VelocityCommand& command) { return command.vector().isZero(0); }

FlightStream::FlightStream(const CommandLimits& envelope, double period_s)
    : envelope_{float_limits(envelope.speed), envelope.acceleration}, period_s_(period_s) {}

void FlightStream::want(const FlightSetpoint& setpoint, double fresh_until_s) {
  wanted_ = setpoint;
  fresh_until_s_ = fresh_until_s;
}

void FlightStream::start_from_rest(double now_s) {
  sent_ = VelocityCommand::hover();
  sent_s_ = now_s;
}

bool FlightStream::is_due(double now_s) const {
  const bool outlived = now_s >= fresh_until_s_ && !is_hover(sent_);
  return has_begun() && (outlived || now_s - sent_s_ >= period_s_);
}

FlightSetpoint FlightStream::next(double now_s) {
  FlightSetpoint setpoint{VelocityCommand::hover(), now_s};
  if (now_s < fresh_until_s_) {
    // It starts from rest. Of a longer silence two periods count: a gap is no leave to jump.
    const double duration_s = has_begun() ? std::min(now_s - sent_s_, 2 * period_s_) : 0;
    setpoint = {as_floats(limited(sent_, wanted_.command, envelope_, duration_s)),
                wanted_.captured_s};
  }
  sent_ = setpoint.command;
  sent_s_ = now_s;
  ++sent_count_;
  zero_count_ += is_hover(sent_) ? 1 : 0;
  return setpoint;
}

}  // namespace kestrel
