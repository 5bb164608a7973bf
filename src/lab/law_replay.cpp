#include "kestrel/lab/law_replay.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kestrel/eval/spread.hpp"
#include "kestrel/lab/logged_features.hpp"
#include "kestrel/loop/decide.hpp"

namespace kestrel {
LawReplay replayed(const LogFile& log, const Task& task, Law law) {
  Task with_law = task;
  with_law.servo.law = law;
  LawReplay replay{law, {}};
  replay.frames.reserve(log.rows.size());
  DecisionState state;
  for (const LogRow& row : log.rows) {
    const Decision decision =
        decide(logged_features(row, task), row.attitude, row.stamp_s, state, with_law);
    state = decision.next;
    ReplayedFrame frame;
    frame.frame = row.frame;
    frame.stamp_s = row.stamp_s;
    frame.sent = decision.command;
    frame.refusal = decision.refusal;
    if (decision.servo) {
      frame.wanted = decision.wanted;
      frame.condition = decision.servo->condition;
    }
    replay.frames.push_back(frame);
  }
  return replay;
}

ReplayDifference difference(const LawReplay& replay, const LogFile& log) {
  ReplayDifference result;
  std::vector<double> speeds;
  std::vector<double> rates;
  for (std::size_t i = 0; i < std::min(replay.frames.size(), log.rows.size()); ++i) {
    if (!replay.frames[i].wanted) continue;
    ++result.answered;
    const LogRow& row = log.rows[i];
    if (!row.servo || !row.decision || row.decision->state != CommandState::Servo) continue;
    const Eigen::Vector4d d = replay.frames[i].wanted->vector() - row.decision->wanted.vector();
    speeds.push_back(d.head<3>().norm());
    rates.push_back(std::abs(d[3]));
  }
  if (const auto spread = spread_of(std::move(speeds))) {
    result.median_m_s = spread->median;
    result.largest_m_s = spread->max;
  }
  if (const auto spread = spread_of(std::move(rates))) {
    result.median_rad_s = spread->median;
    result.largest_rad_s = spread->max;
  }
  return result;
}

}  // namespace kestrel
