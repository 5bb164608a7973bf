#include "plot_module.hpp"

#include <memory>
#include <utility>

#include <visp3/gui/vpPlot.h>

#ifdef ENABLE_VISP_NAMESPACE
using namespace VISP_NAMESPACE_NAME;
#endif

namespace kestrel::app {

struct ShownPlots {
  ShownPlots(const PlotWindow& window, std::vector<PlotGraph> shown)
      : plot(unsigned(shown.size()), unsigned(window.height_px), 1000, window.left_px,
             window.top_px, window.title),
        graphs(std::move(shown)) {}
  vpPlot plot;
  std::vector<PlotGraph> graphs;
};

namespace {

ShownPlots* open_plots(const PlotWindow& window, const std::vector<PlotGraph>& graphs) {
  auto shown = std::make_unique<ShownPlots>(window, graphs);
  for (unsigned graph = 0; graph < graphs.size(); ++graph) {
    const PlotGraph& wanted = graphs[graph];
    shown->plot.initGraph(graph, unsigned(wanted.curves.size()));
    shown->plot.setTitle(graph, wanted.title);
    shown->plot.setUnitX(graph, "s");
    shown->plot.setUnitY(graph, wanted.unit);
    for (unsigned curve = 0; curve < wanted.curves.size(); ++curve) {
      shown->plot.setLegend(graph, curve, wanted.curves[curve]);
    }
  }
  return shown.release();
}

void span(ShownPlots& shown, double from_s, double to_s) {
  constexpr double kLittle = 1e-3;  // an axis has a length; points beyond it make it longer
  for (unsigned graph = 0; graph < shown.graphs.size(); ++graph) {
    shown.plot.initRange(graph, from_s, to_s, -kLittle, kLittle);
  }
}

void begin(ShownPlots& shown, const std::string& heading) {
  for (unsigned graph = 0; graph < shown.graphs.size(); ++graph) shown.plot.resetPointList(graph);
  const std::string& title = shown.graphs[0].title;
  shown.plot.setTitle(0, heading.empty() ? title : heading + ": " + title);
}

void add(ShownPlots& shown, int graph, int curve, double x, double y) {
  shown.plot.plot(unsigned(graph), unsigned(curve), x, y);
}

void close_plots(ShownPlots* shown) { delete shown; }

}  // namespace

extern "C" const PlotModule kKestrelModule;
const PlotModule kKestrelModule{open_plots, span, begin, add, close_plots};

}  // namespace kestrel::app
