#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "kestrel/eval/bench.hpp"

namespace kestrel {

/// What became of one frame.
struct BenchFrame {
  std::int64_t frame = 0;  // Frame::index
  BenchAnswer answer;
  double time_s = 0;  // the tracker's own, by the clock that was given
};

/// Whether a run went through its sequence.
enum class BenchEnd {
  Done,
  Refused,  // the method did not take the template: a result, with no frame found
  Failed,   // the frames could not be read, or the tracker broke: says nothing of the method
};

/// One method over one sequence.
struct BenchRun {
  std::string sequence;
  std::string method;
  BenchEnd end = BenchEnd::Done;
  std::string reason;  // why it did not go through; empty for Done
  PixelBox template_px;
  std::vector<std::string> skipped;  // frames that could not be decoded, a sentence each
  double learn_s = 0;                // to learn the template
  std::vector<BenchFrame> frames;
};

/// What a run needs from outside, as nothing here reads a clock or a signal.
struct BenchHooks {
  std::function<double()> clock_s;       // of the calling thread, best its processor time
  std::function<bool()> is_interrupted;  // asked before each frame
  std::function<void()> frame_done;      // told after each frame
};

/// Learns the template in the first frame and tracks it through all frames, the first included.
/// Empty when it was interrupted. Nothing that the sequence or the method throws leaves it: that is
/// kept in end and reason.
std::optional<BenchRun> run_bench(const BenchSequence& sequence, const BenchMethod& method,
                                  const BenchHooks& hooks);

/// "done", "refused", "failed".
const char* name(BenchEnd end);

}  // namespace kestrel
