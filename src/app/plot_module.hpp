#pragma once

#include <string>
#include <vector>

namespace kestrel::app {

/// One graph of a window and the curves in it.
struct PlotGraph {
  std::string title;
  std::string unit;
  std::vector<std::string> curves;
};

/// Where a window of plots is opened on the screen, and how high it is.
struct PlotWindow {
  std::string title;
  int left_px = 0;
  int top_px = 0;
  int height_px = 800;
};

/// A window of plots; what is in it is the module's.
struct ShownPlots;

/// What kestrel_plot.so offers (ViSP's vpPlot): a window of graphs over time, s.
struct PlotModule {
  /// Opens the window, of at most four graphs. Throws what ViSP throws.
  ShownPlots* (*open)(const PlotWindow& window, const std::vector<PlotGraph>& graphs);
  /// Sets the axis of time of all graphs; the other one grows by itself.
  void (*span)(ShownPlots& plots, double from_s, double to_s);
  /// Empties all graphs and puts a heading above the first.
  void (*begin)(ShownPlots& plots, const std::string& heading);
  /// Draws one more point of a curve.
  void (*add)(ShownPlots& plots, int graph, int curve, double x, double y);
  void (*close)(ShownPlots* plots);
};

}  // namespace kestrel::app
