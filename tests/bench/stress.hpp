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
/// | class         | what is hard                                          | fastest corner,
/// px/frame | | ------------- | ----------------------------------------------------- |
/// ------------------------ | | nominal       | nothing: a gentle motion | 4 | | scale         |
/// half to twice the size                                | 6                        | | rotation |
/// in the plane, to +-180 degrees                        | 11                       | | tilt | out
/// of the plane, to 60 degrees about every axis      | 6                        | | blur          |
/// exposure 0.6 of the frame time, defocus to sigma 2 px | 15                       | | noise |
/// sigma 8, contrast 0.5-1.6, bias +-40, shade, shadow   | 4                        | | occlusion
/// | something textured hides up to 40 %                   | 4                        | | flight |
/// vibration, its blur, noise; a facade of equal windows | 13                       | |
/// flight_window | the same, the template being a window of the facade   | 13 | | fast          |
/// speed                                                 | 20                       | | blackout |
/// 18 frames seen, 12 black, white, grey, without target | jumps                    | | | or with
/// another one; back elsewhere, at half to twice |                          | |               | the
/// size and any angle                                |                          | | small         |
/// a template of 60x46 px                                | 4                        |
///
/// stress_test prints and bounds the speeds.
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
