#pragma once

#include <string>
#include <vector>

namespace kestrel::app {

/// A window of plots; what is in it is the module's.
struct ShownPlots;

/// What kestrel_plot.so offers (ViSP's vpPlot): a window of graphs with one curve for each name.
struct PlotModule {
  /// Opens the window; titles and units: one for each graph. Throws what ViSP throws.
  ShownPlots* (*open)(const std::vector<std::string>& titles, const std::vector<std::string>& units,
                      const std::vector<std::string>& curves);
  /// Empties all graphs and puts a heading above the first.
  void (*begin)(ShownPlots& plots, const std::string& heading);
  /// Draws one more point of a curve.
  void (*add)(ShownPlots& plots, int graph, int curve, double x, double y);
  void (*close)(ShownPlots* plots);
};

}  // namespace kestrel::app
