#pragma once

#include <string>
#include <vector>

namespace kestrel {

/// How many values lie in [low, low + width).
struct HistogramBin {
  double low = 0;
  long count = 0;
};

/// The bins of the finite values: from the first that holds one to the last, empty ones between
/// them included; their edges are multiples of the width. Throws std::invalid_argument for a width
/// that is not positive and finite, or so narrow that there were more than 100 000 bins.
std::vector<HistogramBin> histogram_bins(const std::vector<double>& values, double width);

/// What svg_histogram draws.
struct Histogram {
  std::string title;
  std::string value_label;
  std::vector<double> values;
  std::string when_empty = "no values to show";
};

/// A static SVG picture of how often the values occur: bins of 1, 2 or 5 times a power of ten,
/// about forty over the middle 98 % of the values; what lies beyond a picture four times as wide as
/// those is counted in the title, not drawn. Colours as svg_plot.
std::string svg_histogram(const Histogram& histogram);

}  // namespace kestrel
