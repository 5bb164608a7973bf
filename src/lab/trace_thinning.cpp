#include "kestrel/lab/trace_thinning.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

namespace kestrel {
namespace {

constexpr double kLowest = -8;  // log10: what is smaller is rounding
constexpr double kLargest = 1e5;

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

bool is_logarithmic(const std::string& column) {
  return column == "error_norm" || column == "condition" || column == "sigma_min" ||
         (column.size() == 2 && column[0] == 's' && std::isdigit(int(column[1])));
}

/// One stored unit; 0 for a column that is not drawn.
double resolution_of(const std::string& column) {
  if (is_logarithmic(column)) return 0.002;
  if (ends_with(column, "_px")) return 0.25;
  if (column[0] == 'z' && ends_with(column, "_m")) return 0;  // depths of the points
  if (ends_with(column, "_m_s") || ends_with(column, "_rad_s")) return 2e-4;
  if (ends_with(column, "_m") || ends_with(column, "_rad")) return 5e-4;
  return 0;
}

double drawn(double value, bool logarithmic) {
  if (std::isnan(value)) return value;
  if (logarithmic) return value > 1e-8 ? std::min(std::log10(value), -kLowest * 2) : kLowest;
  return std::clamp(value, -kLargest, kLargest);
}

struct Scaled {
  const std::vector<double>* values;
  double tolerance;
};

std::vector<Scaled> scaled(const std::vector<TraceChannel>& channels) {
  std::vector<Scaled> out;
  for (const TraceChannel& channel : channels) {
    double low = kLargest;
    double high = -kLargest;
    for (const double value : channel.values) {
      if (!std::isnan(value)) low = std::min(low, value), high = std::max(high, value);
    }
    const double range = std::max(high - low, 0.);
    out.push_back({&channel.values, std::max(0.005 * range, channel.resolution)});
  }
  return out;
}

/// The row between first and last that the line between these misses most, and by how many
/// tolerances.
std::pair<std::size_t, double> worst(const std::vector<double>& time_s,
                                     const std::vector<Scaled>& channels, std::size_t first,
                                     std::size_t last) {
  std::pair<std::size_t, double> found{first, 0};
  const double span = time_s[last] - time_s[first];
  for (const Scaled& channel : channels) {
    const auto& v = *channel.values;
    const double slope = span > 0 ? (v[last] - v[first]) / span : 0;
    for (std::size_t i = first + 1; i < last; ++i) {
      const bool gap_at_ends = std::isnan(v[first]) || std::isnan(v[last]);
      double miss = std::abs(v[first] + slope * (time_s[i] - time_s[first]) - v[i]);
      if (std::isnan(v[i]) || gap_at_ends) {
        const bool changes =
            std::isnan(v[i]) != std::isnan(v[i - 1]) || std::isnan(v[i]) != std::isnan(v[i + 1]);
        miss = changes ? 1e9 : 0;
      }
      if (miss / channel.tolerance > found.second) found = {i, miss / channel.tolerance};
    }
  }
  return found;
}

struct Stretch {
  std::size_t first;
  std::size_t last;
  std::size_t row;
  double miss;
};

}  // namespace

std::vector<TraceChannel> drawn_channels(const RunTrace& trace) {
  std::vector<TraceChannel> out;
  for (const std::string& column : trace.columns) {
    const double resolution = resolution_of(column);
    if (resolution == 0) continue;
    TraceChannel channel{column, trace.column(column), resolution};
    for (double& value : channel.values) value = drawn(value, is_logarithmic(column));
    out.push_back(std::move(channel));
  }
  return out;
}

std::vector<std::size_t> kept_rows(const std::vector<double>& time_s,
                                   const std::vector<TraceChannel>& channels, std::size_t most) {
  if (time_s.empty()) return {};
  std::vector<std::size_t> kept{0};
  if (time_s.size() > 1) kept.push_back(time_s.size() - 1);
  const std::vector<Scaled> scales = scaled(channels);
  const auto less = [](const Stretch& a, const Stretch& b) { return a.miss < b.miss; };
  std::vector<Stretch> heap;  // the worst on top: where rows are few they go where they help most
  const auto push = [&](std::size_t first, std::size_t last) {
    if (last < first + 2) return;
    const auto [row, miss] = worst(time_s, scales, first, last);
    if (row == first) return;
    heap.push_back({first, last, row, miss});
    std::push_heap(heap.begin(), heap.end(), less);
  };
  push(0, time_s.size() - 1);
  while (!heap.empty() && kept.size() < most && heap.front().miss > 1) {
    std::pop_heap(heap.begin(), heap.end(), less);
    const Stretch stretch = heap.back();
    heap.pop_back();
    kept.push_back(stretch.row);
    push(stretch.first, stretch.row);
    push(stretch.row, stretch.last);
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

RunTrace thinned(const RunTrace& trace, std::size_t most) {
  const std::vector<double> time_s = trace.column("time_s");
  if (time_s.empty()) return trace;
  RunTrace out{trace.columns, {}};
  for (const std::size_t row : kept_rows(time_s, drawn_channels(trace), most)) {
    out.rows.push_back(trace.rows[row]);
  }
  return out;
}

}  // namespace kestrel
