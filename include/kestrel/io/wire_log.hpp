#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "kestrel/io/csv.hpp"
#include "kestrel/io/report.hpp"

namespace kestrel {

/// When one command left for the wire, s.
struct WireTime {
  double sent_s = 0;
  /// Capture of the frame it was decided on, on the same clock; empty for zeros that rest on none.
  std::optional<double> capture_s;
};

/// Periods and latencies of a stream of commands, in the order they were sent.
struct WireStatistics {
  std::vector<double> period_ms;  // from one command to the next
  /// From the capture of a frame to the first command that rests on it; a command that is sent
  /// again is no news and is left out.
  std::vector<double> latency_ms;
};

WireStatistics wire_statistics(const std::vector<WireTime>& times);

/// The table of the times, row by row, so that an interrupted run keeps all it has: sent_s and
/// capture_s count from the first command, period_ms, age_ms of the frame, first (1 for the first
/// command of its frame). Empty fields where there is nothing to tell.
class WireLog {
 public:
  /// Throws as LineFile.
  explicit WireLog(const std::filesystem::path& path);

  /// Throws as LineFile.
  void write(const WireTime& time);

  /// All so far.
  const std::vector<WireTime>& times() const { return times_; }

 private:
  LineFile file_;
  std::vector<WireTime> times_;
  std::optional<double> newest_capture_s_;
};

/// Jitter and latency as histograms and in a table: median, 95 and 99 %, largest.
ReportSection wire_section(const std::vector<WireTime>& times);

}  // namespace kestrel
