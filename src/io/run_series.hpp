#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "kestrel/io/run_log.hpp"
#include "kestrel/io/svg_plot.hpp"

/// Columns of a run log as series of a plot.
namespace kestrel {

inline constexpr double kDegrees = 180 / M_PI;

/// value(row) of each row.
template <class Value>
std::vector<double> column(const LogFile& log, Value value) {
  std::vector<double> out;
  out.reserve(log.rows.size());
  for (const LogRow& row : log.rows) out.push_back(value(row));
  return out;
}

/// value(*part) where the row has that part, else NaN: a gap in the plot.
template <class Part, class Value>
std::vector<double> column(const LogFile& log, std::optional<Part> LogRow::*part, Value value) {
  return column(log, [&](const LogRow& row) {
    return row.*part ? double(value(*(row.*part))) : std::numeric_limits<double>::quiet_NaN();
  });
}

/// Seconds since the first frame.
inline std::vector<double> times(const LogFile& log) {
  const double first = log.rows.empty() ? 0 : log.rows.front().stamp_s;
  return column(log, [&](const LogRow& row) { return row.stamp_s - first; });
}

/// A plot without series yet.
inline Plot empty_plot(const std::string& title, const std::string& x_label,
                       const std::string& y_label) {
  Plot plot;
  plot.title = title;
  plot.x_label = x_label;
  plot.y_label = y_label;
  return plot;
}

/// A plot over time without series yet.
inline Plot time_plot(const std::string& title, const std::string& y_label) {
  return empty_plot(title, "time (s)", y_label);
}

}  // namespace kestrel
