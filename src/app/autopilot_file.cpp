#include "autopilot_file.hpp"

#include <stdexcept>

namespace kestrel::app {

AutopilotOptions read_autopilot(const Section& root) {
  AutopilotOptions o;
  const std::optional<Section> section = root.child_if("autopilot");
  if (!section) return o;
  o.rate_hz = section->number("rate_hz", o.rate_hz);
  o.stream.time_to_live_s = section->number("time_to_live_s", o.stream.time_to_live_s);
  o.stream.decay_s = section->number("decay_s", o.stream.decay_s);
  o.stream.zero_after_s = section->number("zero_after_s", o.stream.zero_after_s);
  o.stream.zeros_for_s = section->number("zeros_for_s", o.stream.zeros_for_s);
  o.stream.then = section->choice<AfterZeros>(
      "then", {{"silence", AfterZeros::Silence}, {"zeros", AfterZeros::Zeros}}, o.stream.then);
  o.handshake.take_control = section->flag("take_control", o.handshake.take_control);
  o.handshake.allow_arming = section->flag("allow_arming", o.handshake.allow_arming);
  o.handshake.takeoff_m = section->number("takeoff_m", o.handshake.takeoff_m);
  o.attitude_hz = section->number("attitude_hz", o.attitude_hz);
  const std::int64_t vehicle = section->integer("vehicle", o.vehicle);
  if (vehicle < 0 || vehicle > 255) section->fail("vehicle", "must be 0 to 255");
  o.vehicle = std::uint8_t(vehicle);
  const std::int64_t component = section->integer("component", o.component_id);
  if (component < 1 || component > 255) section->fail("component", "must be 1 to 255");
  o.component_id = std::uint8_t(component);
  try {
    o.check();
  } catch (const std::invalid_argument& error) {
    section->fail("", error.what());
  }
  return o;
}

}  // namespace kestrel::app
