#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

#include "kestrel/io/csv.hpp"
#include "kestrel/vision/track.hpp"

namespace kestrel {

/// Places of a frame's matched keypoints in the image, px.
struct LoggedMatches {
  std::vector<Pixel> inliers;  // that agree
  std::vector<Pixel> others;   // that do not
};

/// What a viewer or a log keeps of a frame's matches: the first kMost of those that agree, and as
/// many of the others, so that a frame full of texture costs no more than another.
LoggedMatches logged_matches(const Track& track);

/// Matched keypoints beside a run's log, to be drawn again: CSV, a line for each frame in which
/// some were matched: its number, then the places that agree, then the others, as `u v u v ...` to
/// a tenth of a pixel. A picture that is followed without keypoints leaves no line, so the file is
/// small; a frame's line is 4 kB at most. The same run gives the same file.
class MatchLog {
 public:
  static constexpr std::size_t kMost = 200;

  /// Creates the file and writes the header. Throws as LineFile.
  explicit MatchLog(const std::filesystem::path& path);

  /// Appends a line where there is something to tell. Throws as LineFile.
  void write(std::int64_t frame, const Track& track);

 private:
  LineFile file_;
};

/// What MatchLog wrote, by the numbers of the frames; empty for a file that is not there: older
/// runs have none. Lines that were cut short are left out. Throws std::runtime_error `file:line:
/// what is wrong` for a file that is no such log.
std::map<std::int64_t, LoggedMatches> read_matches(const std::filesystem::path& path);

}  // namespace kestrel
