#pragma once

#include <limits>
#include <string>
#include <vector>

namespace kestrel {

/// One cell: a number, or a word in its place.
struct HeatCell {
  double value = std::numeric_limits<double>::quiet_NaN();
  std::string word;  // not empty: a category, hatched and named in the legend
};

/// What svg_heat_map draws: cells[row][column], row 0 at the bottom, column 0 to the left. Missing
/// cells stay empty.
struct HeatMap {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<std::string> x;  // name of each column
  std::vector<std::string> y;  // name of each row
  std::vector<std::vector<HeatCell>> cells;
  std::string value_label;
  std::string when_empty = "no values to show";
  double width_px = 640;
};

/// A static SVG picture of two swept parameters: numbers by darkness and in digits, words by hatch
/// with the first letters of them (`C`, or `Co` where two begin alike); the legend names both.
std::string svg_heat_map(const HeatMap& map);

}  // namespace kestrel
