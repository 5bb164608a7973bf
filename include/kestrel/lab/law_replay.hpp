#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "kestrel/io/run_log.hpp"
#include "kestrel/loop/task.hpp"
#include "kestrel/servo/control_law.hpp"

namespace kestrel {

/// What a law would have commanded in one frame of a recorded run.
struct ReplayedFrame {
  std::int64_t frame = 0;
  double stamp_s = 0;
  std::optional<VelocityCommand> wanted;  // before the limits; empty: no answer, see refusal
  VelocityCommand sent;                   // with the task's limits and failsafe, on its own
  LawRefusal refusal = LawRefusal::None;  // None without a wanted command: the target was not seen
  double condition = 0;
};

/// One law over all frames of a recorded run.
struct LawReplay {
  Law law = Law::Mean;
  std::vector<ReplayedFrame> frames;
};

/// How far a law's wish was from the one that flew.
struct ReplayDifference {
  int answered = 0;                  // frames with a command of this law
  std::optional<double> median_m_s;  // |difference| of the translations, over frames both answered
  std::optional<double> largest_m_s;
  std::optional<double> median_rad_s;  // of the yaw rates
  std::optional<double> largest_rad_s;
};

/// What another law would have commanded at each frame of a recorded run, given what was measured
/// there: the run itself stays as it was flown. The laws that learn are told that the camera moved
/// as the replayed commands said, smooth starts begin with the first answer.
LawReplay replayed(const LogFile& log, const Task& task, Law law);

/// A replay against what the run's own law wanted.
ReplayDifference difference(const LawReplay& replay, const LogFile& log);

}  // namespace kestrel
