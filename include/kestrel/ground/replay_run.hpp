#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "kestrel/ground/ground_view.hpp"
#include "kestrel/io/match_log.hpp"
#include "kestrel/io/run_log.hpp"
#include "kestrel/loop/task.hpp"

namespace kestrel {

/// A recorded run, to be shown again.
struct ReplayRun {
  std::string name;
  LogFile log;                                    // with a row at least
  std::vector<double> chain_ms;                   // one a row; NaN: not known
  std::map<std::int64_t, LoggedMatches> matches;  // by the frame's number; older runs have none
  std::optional<Task> task;        // absent: of `track`, or it cannot be read any more
  std::vector<std::string> notes;  // what is missing and why, for a human
};

/// Processing times of a run's rows out of its timing.csv, ms: the column chain_ms of the same
/// frame, NaN where there is none; all NaN without the file. Throws FileError for a file that is no
/// such table.
std::vector<double> chain_times_ms(const std::filesystem::path& timing_csv, const LogFile& log);

/// Width and height of the pictures that the outlines are in, px: of the task's camera, else the
/// smallest that holds all outlines and windows (640x480 or more).
std::array<int, 2> picture_size_px(const ReplayRun& run);

/// A row as the viewers of a flight see it. A picture that is empty becomes a black one.
GroundView replay_view(const ReplayRun& run, std::size_t row, const cv::Mat& picture);

/// The whole run for the curves, a JSON object: name, notes, stamp_s, frame, found (true, false),
/// and the columns errors (9 a row: the norm first), twist (6), command (8: sent, then wanted),
/// condition (1), time (1, ms); null for a row without.
std::string json(const ReplayRun& run);

}  // namespace kestrel
