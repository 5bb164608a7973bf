#pragma once

#include "kestrel/geometry/plane_pose.hpp"
#include "kestrel/io/live_options.hpp"
#include "kestrel/io/yaml_section.hpp"
#include "kestrel/loop/timing.hpp"
#include "kestrel/servo/servo.hpp"
#include "kestrel/vehicle/failsafe.hpp"
#include "kestrel/vehicle/limits.hpp"
#include "kestrel/vision/track_options.hpp"

namespace kestrel {

/// The options of each stage from the section of a task file that is named after it; keys that are
/// absent keep the defaults of the structs. tasks/README.md documents every key. Throws FileError
/// with the line for an option that its check() refuses.
TrackOptions read_track_options(const Section& root);     // track:
PlanePoseOptions read_pose_options(const Section& root);  // pose:
ServoOptions read_servo_options(const Section& root);     // servo:
CommandLimits read_command_limits(const Section& root);   // limits: {speed, acceleration}
LossOptions read_loss_options(const Section& root);       // loss:
LiveOptions read_live_options(const Section& root);       // capture:
TimingOptions read_timing_options(const Section& root);   // timing:

}  // namespace kestrel
