#include "plot_module.hpp"

#include <memory>

#include <visp3/gui/vpPlot.h>

#ifdef ENABLE_VISP_NAMESPACE
using namespace VISP_NAMESPACE_NAME;
#endif

namespace kestrel::app {

struct ShownPlots {
  ShownPlots(unsigned graphs, const std::string& title)
      : plot(graphs, 800, 1000, 0, 0, title), count(graphs) {}
  vpPlot plot;
  unsigned count;
  std::vector<std::string> titles;
};

namespace {

ShownPlots* open_plots(const std::vector<std::string>& titles,
                       const std::vector<std::string>& units,
                       const std::vector<std::string>& curves) {
  auto shown = std::make_unique<ShownPlots>(unsigned(titles.size()), "kestrel compare");
  shown->titles = titles;
  for (unsigned graph = 0; graph < titles.size(); ++graph) {
    shown->plot.initGraph(graph, unsigned(curves.size()));
    shown->plot.setTitle(graph, titles[graph]);
    shown->plot.setUnitX(graph, "s");
    shown->plot.setUnitY(graph, units[graph]);
    for (unsigned curve = 0; curve < curves.size(); ++curve) {
      shown->plot.setLegend(graph, curve, curves[curve]);
    }
  }
  return shown.release();
}

void begin(ShownPlots& shown, const std::string& heading) {
  for (unsigned graph = 0; graph < shown.count; ++graph) shown.plot.resetPointList(graph);
  shown.plot.setTitle(0, heading + ": " + shown.titles[0]);
}

void add(ShownPlots& shown, int graph, int curve, double x, double y) {
  shown.plot.plot(unsigned(graph), unsigned(curve), x, y);
}

void close_plots(ShownPlots* shown) { delete shown; }

}  // namespace

extern "C" const PlotModule kKestrelModule;
const PlotModule kKestrelModule{open_plots, begin, add, close_plots};

}  // namespace kestrel::app
