#include <cmath>

#include <fmt/format.h>

#include "kestrel/io/svg_bars.hpp"
#include "kestrel/io/svg_heat_map.hpp"
#include "kestrel/lab/lab_figures.hpp"

// The pictures of lab_figures.hpp that show figures of many runs.
namespace kestrel {
namespace {

std::vector<std::string> shown(const std::vector<double>& values) {
  std::vector<std::string> out;
  out.reserve(values.size());
  for (const double value : values) out.push_back(fmt::format("{:.4g}", value));
  return out;
}

HeatCell heat_cell(const LabMap::Cell& cell) {
  if (cell.value && std::isfinite(*cell.value)) return {*cell.value, ""};
  std::string word = name(cell.end);
  for (char& c : word)
    if (c == '_') c = ' ';
  return {0, word};
}

}  // namespace

std::string basin_figure(const std::vector<LabBasin>& basins) {
  BarChart chart;
  chart.title = "Starts from which the goal was reached";
  chart.value_label = "percent of the poses";
  for (const LabBasin& basin : basins) {
    const double share = basin.poses > 0 ? double(basin.reached) / basin.poses : std::nan("");
    Bar bar{basin.law, 100 * share, 100 * basin.low, 100 * basin.high};
    bar.note = fmt::format("{}/{}", basin.reached, basin.poses);
    chart.bars.push_back(std::move(bar));
  }
  return svg_bars(chart);
}

std::string map_figure(const LabMap& map) {
  HeatMap picture;
  picture.title = map.law + (map.title.empty() ? "" : ": " + map.title);
  picture.x_label = map.x_label;
  picture.y_label = map.y_label;
  picture.value_label = map.value_label;
  picture.x = shown(map.x);
  picture.y = shown(map.y);
  for (const auto& row : map.cells) {
    std::vector<HeatCell> cells;
    cells.reserve(row.size());
    for (const LabMap::Cell& cell : row) cells.push_back(heat_cell(cell));
    picture.cells.push_back(std::move(cells));
  }
  return svg_heat_map(picture);
}

std::string order_figure(const std::vector<LabOrder>& orders) {
  BarChart chart;
  chart.title = "Order of accuracy";
  chart.value_label = "slope of log |J⁺e − ξ| over log |ξ|";
  for (const LabOrder& order : orders) {
    Bar bar{order.law, order.slope.value_or(std::nan(""))};
    if (order.slope) bar.note = fmt::format("{:.3f}", *order.slope);
    chart.bars.push_back(std::move(bar));
  }
  return svg_bars(chart);
}

}  // namespace kestrel
