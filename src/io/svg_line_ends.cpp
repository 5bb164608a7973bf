#include "svg_line_ends.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "svg_parts.hpp"
#include "svg_path.hpp"

namespace kestrel::svg {
namespace {

constexpr double kRow = 11.5;
constexpr double kJoin = 26;   // from the axes to the names
constexpr double kWide = 6.2;  // a letter of the names over one of text_width

struct End {
  std::size_t series = 0;
  double x = 0;
  double y = 0;      // of the line
  double label = 0;  // of the name
};

std::vector<End> ends(const Plot& plot, const Axis& x, const Axis& y) {
  std::vector<End> out;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& series = plot.series[i];
    for (std::size_t k = std::min(series.x.size(), series.y.size()); k-- > 0;) {
      const double px = x.at(series.x[k]);
      const double py = y.at(series.y[k]);
      if (!std::isfinite(px) || !std::isfinite(py)) continue;
      if (!series.name.empty()) out.push_back({i, px, py, py});
      break;
    }
  }
  return out;
}

/// Rows at least kRow apart, inside top .. bottom as far as there is room.
void move_apart(std::vector<End>& all, double top, double bottom) {
  std::stable_sort(all.begin(), all.end(), [](const End& a, const End& b) { return a.y < b.y; });
  double lowest = top;
  for (End& end : all) {
    end.label = std::max(end.label, lowest);
    lowest = end.label + kRow;
  }
  double highest = bottom;
  for (auto end = all.rbegin(); end != all.rend(); ++end) {
    end->label = std::min(end->label, highest);
    highest = end->label - kRow;
  }
}

}  // namespace

double line_end_width(const Plot& plot) {
  double widest = 0;
  if (plot.names != Plot::Names::LineEnds) return 0;
  for (const Series& series : plot.series)
    if (!series.name.empty()) widest = std::max(widest, text_width(series.name));
  return widest > 0 ? kJoin + widest * kWide / 6.9 : 0;
}

std::string line_ends(const Plot& plot, const Axis& x, const Axis& y) {
  std::vector<End> all = ends(plot, x, y);
  move_apart(all, std::min(y.begin, y.end) + 4, std::max(y.begin, y.end) - 4);
  std::string out;
  for (const End& end : all) {
    const std::string classes = line_classes(plot.series[end.series], end.series);
    out += fmt::format("<path class=\"{} ka\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}h10\"/>\n", classes,
                       end.x, end.y, x.end + kJoin - 14, end.label);
    out += text(x.end + kJoin, end.label + 4, "start", "ke", plot.series[end.series].name);
  }
  return out;
}

}  // namespace kestrel::svg
