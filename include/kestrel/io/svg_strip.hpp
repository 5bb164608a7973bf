#pragma once

#include <string>
#include <vector>

namespace kestrel {

/// What svg_strip draws: which of a few states held when.
struct Strip {
  std::string title;
  std::string x_label;
  std::vector<std::string> lanes{};  // the states, from the top
  std::vector<double> x;             // ascending
  std::vector<std::string> states;   // from x[i] on; one that is no lane is drawn nowhere
  double width_px = 640;
};

/// A static SVG picture with one lane for each state and a bar where it held, its share written at
/// the right; looks like svg_plot.
std::string svg_strip(const Strip& strip);

}  // namespace kestrel
