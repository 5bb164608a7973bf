#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "kestrel/eval/bench.hpp"

/// Sequences rendered from real pictures, with exact truth: 640x480, 30 frames/s, a pinhole camera
/// (f = 600 px) before a poster on a wall. Frame 0 shows the poster from straight in front, clean;
/// the template is the whole of it there. Everything is in memory and a function of the options:
/// frame k is the same whatever was rendered before it.
///
/// What is hard in each class, and its fastest corner, px/frame (stress_test prints and bounds it):
/// - nominal, 4: nothing, a gentle motion
/// - scale, 6: half to twice the size
/// - rotation, 11: in the plane, to +-180 degrees
/// - tilt, 6: out of the plane, to 60 degrees about every axis
/// - blur, 15: exposure 0.6 of the frame time, defocus to sigma 2 px
/// - noise, 4: sigma 8, contrast 0.5 to 1.6, bias +-40, a shade that turns, a shadow that passes
/// - occlusion, 4: something textured hides up to 40 %
/// - flight, 13: vibration, its blur (exposure 0.4), noise 4; a facade of equal windows
/// - flight_window, 13: the same, the template being a window of that facade
/// - gust, 26: flight at dusk: twice the vibration, exposure 0.7, noise 8, 60 % contrast, a smaller
///   poster, more tilt
/// - fast, 20: speed
/// - blackout: 18 frames seen, 12 black, white, grey, without the target or with another one; it
///   comes back elsewhere, at half to twice the size and any angle
/// - small, 4: a template of 60x46 px
namespace kestrel::test {

/// The classes by name: the eight that are averaged first, then the extras.
std::vector<std::string> stress_classes();

struct StressOptions {
  std::string cls = "nominal";
  std::string texture = "graffiti";  // a name of stress_textures()
  std::int64_t frames = 150;
  std::uint64_t seed = 1;

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// A sequence and the frames that do not show its target: found there is found wrongly. Frames with
/// less than 60 % of the target in the image have neither a row of truth nor an absence.
struct StressSequence {
  BenchSequence sequence;
  std::set<std::int64_t> absent;
};

/// Rows of truth: where the centres of the template's corner pixels are, px; with an open shutter
/// their mean over the exposure. Throws std::invalid_argument for options that do not check and
/// std::runtime_error when the pictures are not installed.
StressSequence stress_sequence(const StressOptions& options);

/// All frames of a sequence, in order.
std::vector<cv::Mat> rendered_frames(const StressSequence& sequence);

}  // namespace kestrel::test
