#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "kestrel/ground/ground_station.hpp"
#include "kestrel/io/run_log.hpp"
#include "kestrel/loop/step.hpp"

#include "arguments.hpp"
#include "run_recorder.hpp"

namespace kestrel::app {

/// When the law's commands go out where no ground station says so.
enum class Start {
  AtOnce,
  ByClick,  // hover until the left button is clicked in the window, and after each second click
  Paused,   // the same, and the first frame waits for it: the source's time is ours
};

/// Everything one run of the chain needs.
struct Chain {
  FrameSource& source;
  CommandSink& sink;
  Tracker& tracker;
  const Task& task;
  RunRecorder& recorder;
  Pace pace = Pace::AsFastAsPossible;
  /// The helicopter's attitude at a stamp, for frames that come without; null: nobody knows.
  std::function<std::optional<Attitude>(double stamp_s)> attitude{};
  /// The helicopter's velocity at a stamp, NED, m/s, where it is measured; null: nobody knows.
  std::function<std::optional<Eigen::Vector3d>(double stamp_s)> velocity{};
  /// What is put beside the overlay in video and window, if anything; as high as the overlay.
  std::function<cv::Mat(const Frame&, cv::Size overlay_px)> beside{};
  /// Is shown each frame, and may change the chain's course; null: nobody.
  GroundStation* ground = nullptr;
  /// What of a frame's decision may be flown; before: the state at that frame. Null: all of it.
  std::function<Decision(Decision, const DecisionState& before)> steered{};
  /// Of who has no ground station. With one, a left click in the window is its Hover.
  Start start = Start::AtOnce;
  /// How old the frame with this stamp is, s: asked when its command has just been sent. Null:
  /// nobody knows, as of a recording.
  std::function<double(double stamp_s)> age_s{};
};

/// How a run ended.
struct ChainEnd {
  std::string reason;   // for a human
  bool broken = false;  // the source failed in flight
  std::int64_t frames = 0;
  std::int64_t found = 0;
  std::int64_t servoed = 0;  // frames in which the law had an answer
  std::int64_t by_hand = 0;  // frames whose command was an operator's
  std::vector<std::string> skipped;
  std::int64_t blind = 0;           // frames without an image: the source was silent
  std::vector<double> latencies_s;  // from the capture of each frame to its command, if known
  std::int64_t predicted = 0;       // frames whose features were predicted over it
  std::optional<double> least_gain_per_s;  // where the timing allowed less than the task's
  Step last;
};

/// Looks at each step: may add to the row, and says why the run should end, if it should.
using Watch = std::function<std::optional<std::string>(const Frame&, const Step&, LogRow&)>;

/// Folds step() over the frames, the first of which is given: send, log, draw, until the source
/// ends, the watch ends it, the window is closed or Ctrl-C. The last command sent is hover,
/// whatever happened; a source that breaks ends the run, it does not throw.
ChainEnd run_chain(const Chain& chain, Frame frame, const Watch& watch);

/// The corners of the template where the goal wants them, px.
std::array<Pixel, 4> goal_corners(const Template& model, const Task& task);

/// How a run of the chain ended, as lines of a summary.
void add_chain(Summary& summary, const ChainEnd& end, const CommandSink& sink);

/// Period and latency of a run of the chain and what the loop did about them.
void add_timing(Summary& summary, const ChainEnd& end, const Task& task);

}  // namespace kestrel::app
