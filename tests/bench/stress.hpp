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
/// | class         | what is hard                                             | fastest corner,
/// px/frame | | nominal       | nothing: a gentle motion                                 | see
/// stress_test          | | scale         | half to twice the size |                          | |
/// rotation      | in the plane, to +-180 degrees                           | | | tilt          |
/// out of the plane, to 60 degrees about every axis         |                          | | blur |
/// exposure 0.6 of the frame time, defocus to sigma 2 px    |                          | | noise |
/// sigma 8, gain 0.5-1.6, bias +-40, moving shade and shadow|                          | |
/// occlusion     | something textured hides up to 40 %                      | | | flight        |
/// vibration, its blur, noise; a facade of equal windows    |                          | |
/// flight_window | the same, the template being a window of the facade      | | | fast          |
/// the motion of blur, without blur                         |                          | | blackout
/// | black, white, grey, absent, another poster; comes back elsewhere, at another scale and | |
/// angle                                                    |                          | | small |
/// a template of 60x46 px                                   |                          |
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

}  // namespace kestrel::test
