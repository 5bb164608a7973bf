#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kestrel/geometry/pixel.hpp"
#include "kestrel/geometry/transform.hpp"

#include "support/random.hpp"

namespace kestrel::test {

/// amplitude * (sin(2 pi t / period + phase) - sin(phase)): nothing at t = 0.
struct Wave {
  double amplitude = 0;
  double period_frames = 100;
  double phase = 0;

  double at(double t_frames) const;
};

/// Sum of waves.
using Waves = std::vector<Wave>;
double value(const Waves& waves, double t_frames);

/// How the poster lies in the image.
struct StressPose {
  Pixel centre{319.5, 239.5};
  double scale = 1;   // 1: as learned
  double roll = 0;    // clockwise on the screen, rad
  double tilt_x = 0;  // rotation vector of the tilt, in the poster's plane, rad
  double tilt_y = 0;

  /// Of the poster (origin at its centre) before a camera of kFocal px.
  TargetPose camera_from_target() const;
};

/// Focal length; the distance the template is learned from, and what a metre measures there.
inline constexpr double kFocal_px = 600;
inline constexpr double kDistance_m = 3;
inline constexpr double kPxPerMetre = kFocal_px / kDistance_m;

/// What moves in a class of sequences: offsets of the centre (px), log2 of the scale, angles (rad).
struct StressMotion {
  Waves u;
  Waves v;
  Waves octaves;
  Waves roll;
  Waves tilt;
  double tilt_turn_frames = 400;  // the tilt's axis goes round once in this time
  double tilt_axis = 0;           // where it starts, rad
  /// Frames from one jump to another place, scale and angle to the next; 0: none.
  int jump_frames = 0;
  std::string jump_name;  // names the stream of chance of the jumps

  /// Continuous in t but for the jumps; the learned view at t = 0.
  StressPose at(double t_frames) const;
};

/// The motion of a class (see stress_classes). chance varies it: signs, phases and amplitudes (80
/// to 100 %). Throws std::invalid_argument for an unknown class.
StressMotion stress_motion(const std::string& cls, const std::string& name);

/// Pose of the occluder in the poster's plane: it passes over the poster from side to side,
/// turning; beside it in frame 0.
Transform<frame::Target, frame::Target> occluder_pose(double t_frames);

}  // namespace kestrel::test
