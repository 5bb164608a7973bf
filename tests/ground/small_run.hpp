#pragma once

#include <cmath>
#include <string>

#include "kestrel/ground/replay_run.hpp"

namespace kestrel::test {

/// A run of so many frames at 10 Hz whose target moves right by a pixel a frame, seen in all but
/// the second one.
inline ReplayRun small_run(const std::string& name, int frames) {
  ReplayRun run;
  run.name = name;
  for (int i = 0; i < frames; ++i) {
    LogRow row;
    row.frame = 100 + i;
    row.stamp_s = 5 + 0.1 * i;
    if (i != 1) {
      row.status = TrackStatus::Found;
      row.corners = {{{10.0 + i, 10}, {50.0 + i, 10}, {50.0 + i, 40}, {10.0 + i, 40}}};
      row.pose = LoggedPose{{0, 0, 2}, {0, 0, M_PI / 2}, 0.1, false};
      row.servo = LoggedServo{{1, 2, 3, 4, 5, 6, 7, 8}, 14.28286, 30, {}};
    }
    run.log.rows.push_back(row);
    run.chain_ms.push_back(i == 2 ? std::nan("") : 1.5);
  }
  return run;
}

}  // namespace kestrel::test
