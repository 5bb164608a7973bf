#pragma once

#include <string>
#include <vector>

#include "kestrel/io/axis.hpp"

namespace kestrel {

/// How a series is drawn.
enum class Stroke { Solid, Dashed, Faint, Dotted, DashDot };

/// A shape that marks a place of a plot.
enum class Shape { Circle, Cross };

/// One line of a plot; a value that is not finite leaves a gap. The shorter of x and y counts.
struct Series {
  std::string name;  // in the legend; empty: not in it
  std::vector<double> x;
  std::vector<double> y;
  int colour = -1;  // of the palette, 0 ..; -1: by its place in the plot
  Stroke stroke = Stroke::Solid;
};

/// A value that must not be passed: a dashed horizontal line with its name.
struct Limit {
  double y = 0;
  std::string label;
};

/// A marked place; in the legend once for each name.
struct Mark {
  std::string name;
  double x = 0;
  double y = 0;
  Shape shape = Shape::Circle;
  int colour = 0;
};

/// What svg_plot draws.
struct Plot {
  std::string title;
  std::string x_label;
  std::string y_label;
  Spacing y_spacing = Spacing::Linear;
  std::vector<Series> series;
  std::vector<Limit> limits;
  std::vector<Mark> marks;
  enum class Axes {
    Free,       // each axis as long as its values ask for
    Equal,      // one unit is as long on both (linear axes only)
    EqualDown,  // the same, y growing downwards: an image
  } axes = Axes::Free;
  /// Where the names of the lines stand: above, or beside the last value of each.
  enum class Names { Legend, LineEnds } names = Names::Legend;
  std::string when_empty = "no values to show";
  double width_px = 640;
  double height_px = 300;
};

/// A static SVG picture of line plots: a whole document, also to be placed inside HTML; light or
/// dark as the viewer prefers; the colours are Okabe & Ito's (2008), told apart by the
/// colour-blind. Limits far beyond the values are named in a note, not drawn. Lines of many points
/// are thinned to the extremes within each pixel column.
std::string svg_plot(const Plot& plot);

}  // namespace kestrel
