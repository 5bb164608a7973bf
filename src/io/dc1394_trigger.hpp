#pragma once

#include <optional>
#include <string>

#include "kestrel/io/dc1394_camera.hpp"
#include "kestrel/io/live_options.hpp"

#include "dc1394_bus.hpp"

namespace kestrel::iidc {

/// What triggers a camera; empty when it has no trigger.
std::optional<TriggerAbility> trigger_ability(dc1394camera_t& camera);

/// Lets the camera wait for its trigger; without one wanted for none, also where another program
/// left it waiting. Throws std::runtime_error that names the key and what the camera has.
void set_trigger(dc1394camera_t& camera, const std::optional<TriggerSettings>& wanted);

/// Asks a camera whose trigger is this program for its pictures: one at a time.
class SoftwareTrigger {
 public:
  /// rate_hz: so many a second at most; 0: the next one as soon as the last one came. longest_s:
  /// a picture that took longer is taken for lost, and the next one asked for.
  SoftwareTrigger(double rate_hz, double longest_s)
      : period_s_(rate_hz > 0 ? 1 / rate_hz : 0), longest_s_(longest_s) {}
  /// Asks, where it is time to. Throws std::runtime_error when the camera refuses.
  void ask(dc1394camera_t& camera, double now_s);
  void picture_came() { is_asked_ = false; }

 private:
  double period_s_;
  double longest_s_;
  double asked_s_ = -1e9;
  bool is_asked_ = false;
};

/// Why a triggered camera is silent, and what to do.
std::string no_trigger(const TriggerSettings& trigger, double seconds);

}  // namespace kestrel::iidc
