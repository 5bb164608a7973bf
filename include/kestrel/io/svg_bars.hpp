#pragma once

#include <limits>
#include <string>
#include <vector>

namespace kestrel {

/// One bar with its name; a value that is not finite draws none.
struct Bar {
  std::string name;
  double value = 0;
  /// Ends of an interval drawn over the bar; not finite: none.
  double low = std::numeric_limits<double>::quiet_NaN();
  double high = std::numeric_limits<double>::quiet_NaN();
  std::string note{};  // written at the bar's end in place of the value
  int colour = 0;      // of the palette, 0 ..
};

/// What svg_bars draws.
struct BarChart {
  std::string title;
  std::string value_label;
  std::vector<Bar> bars;
  std::string when_empty = "no values to show";
  double width_px = 640;
};

/// A static SVG picture of lying bars below each other, from zero, each with its value beside it;
/// as high as the bars ask for. Colours, light and dark as svg_plot.
std::string svg_bars(const BarChart& chart);

}  // namespace kestrel
