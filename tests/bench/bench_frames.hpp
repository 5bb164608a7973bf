#pragma once

#include <functional>
#include <vector>

#include <benchmark/benchmark.h>

#include "kestrel/geometry/homography.hpp"
#include "kestrel/geometry/pixel.hpp"
#include "kestrel/vision/frame.hpp"

/// What the programs that time whole frames share.
namespace kestrel::test {

/// A rendered sequence in memory, and where its template truly is.
struct BenchFrames {
  std::vector<Frame> frames;
  std::vector<Homography> truth;  // image_from_template
  PixelBox template_px;           // in the first frame
};

/// 60 frames of 640x480 px of the class "nominal" with the picture "graffiti" (bench/stress.hpp),
/// rendered once.
const BenchFrames& whole_frames();

/// The same, each cut to 256x256 px around the target.
const BenchFrames& cropped_frames();

/// Timed calls of a stage: five passes over the frames.
inline constexpr int kCalls = 300;

/// One call for frame k.
using FrameWork = std::function<void(std::size_t k)>;

/// Times calls one by one, k = 0, 1, ..., frames - 1, 0, ...: processor time of this thread, what
/// others do meanwhile hardly counts. prepare is not timed. Work that takes a microsecond does it
/// `repeats` times in a call. Counters: the median and the 99 % point of a call, us.
void time_frames(benchmark::State& state, std::size_t frames, const FrameWork& prepare,
                 const FrameWork& work, int repeats = 1);

/// Times theirs and ours on the same frames, one whole pass after the other, an iteration each.
/// Counters: median and 99 % point of theirs, median of ours, us, and how many times ours theirs
/// takes (of the medians). begin_ours, begin_theirs start a pass and are not timed.
void time_beside(benchmark::State& state, std::size_t frames,
                 const std::function<FrameWork()>& begin_theirs,
                 const std::function<FrameWork()>& begin_ours);

}  // namespace kestrel::test
