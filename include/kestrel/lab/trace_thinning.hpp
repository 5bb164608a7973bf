#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "kestrel/lab/lab_run.hpp"

namespace kestrel {

/// How a column of a trace is drawn and stored for the page.
struct TraceChannel {
  std::string column;
  std::vector<double> values;  // of error_norm, condition and singular values: log10, >= -8
  double resolution = 0;       // of one stored unit
};

/// The columns of a trace that a page draws: u<i>_px and v<i>_px, velocities, positions, angles,
/// error_norm, condition, sigma_min, s1 .. s6; time_s is no channel. NaN stays NaN, others are cut
/// to what fits a drawing (1e5).
std::vector<TraceChannel> drawn_channels(const RunTrace& trace);

/// Rows to keep, ascending, first and last included, so that straight lines over time through them
/// miss no value of any channel by more than half a percent of that channel's range in this run (or
/// its resolution, if larger); at most `most` rows (>= 2), by allowing more where that is too many.
/// A row where a value begins or ends to be NaN is kept with its neighbour. The method is Douglas &
/// Peucker's (1973) on all channels at once.
std::vector<std::size_t> kept_rows(const std::vector<double>& time_s,
                                   const std::vector<TraceChannel>& channels, std::size_t most);

/// The trace with the rows that a page needs.
RunTrace thinned(const RunTrace& trace, std::size_t most);

}  // namespace kestrel
