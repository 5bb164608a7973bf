#include "kestrel/io/svg_heat_map.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "kestrel/io/axis.hpp"

#include "svg_cell.hpp"
#include "svg_parts.hpp"

namespace kestrel {
namespace {

constexpr double kTop = 34;
constexpr double kRight = 14;
constexpr double kCell = 26;  // height
constexpr double kLegend = 22;

std::string on_cell(double x, double y, const std::string& colour, const std::string& words) {
  return fmt::format(
      "<text class=\"kt\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\" style=\"fill:{};"
      "font-size:11px;paint-order:stroke;stroke:{};stroke-width:{}\">{}</text>\n",
      x, y, colour, colour == "#fff" ? "none" : "#fff4e8", colour == "#6d2f00" ? 4 : 0,
      escaped(words));
}

/// The words of a map in the order they come, and how each is written in a cell.
struct Categories {
  std::vector<std::string> words;

  std::string initials(const std::string& word) const {
    for (std::size_t n = 1; n < word.size(); ++n) {
      const auto alike = std::count_if(words.begin(), words.end(), [&](const std::string& other) {
        return other.compare(0, n, word, 0, n) == 0;
      });
      if (alike <= 1) return word.substr(0, n);
    }
    return word;
  }
  int index(const std::string& word) const {
    return int(std::find(words.begin(), words.end(), word) - words.begin());
  }
};

struct Layout {
  Categories categories;
  std::vector<double> values;
  Range range;
  double left = 0;
  double bottom = 0;
  double cell_width = 0;

  double share(double value) const { return (value - range.low) / (range.high - range.low); }
};

Layout layout_of(const HeatMap& map) {
  Layout out;
  for (const auto& row : map.cells) {
    for (const HeatCell& cell : row) {
      const bool is_new = out.categories.index(cell.word) == int(out.categories.words.size());
      if (!cell.word.empty() && is_new) out.categories.words.push_back(cell.word);
      if (cell.word.empty() && std::isfinite(cell.value)) out.values.push_back(cell.value);
    }
  }
  out.range = range_of(out.values, Spacing::Linear, 0);
  double widest = 0;
  for (const std::string& name : map.y) widest = std::max(widest, svg::text_width(name));
  out.left = std::min(widest + 34, map.width_px / 2);
  out.bottom = kTop + kCell * double(std::max<std::size_t>(map.y.size(), 1));
  out.cell_width =
      (map.width_px - kRight - out.left) / double(std::max<std::size_t>(map.x.size(), 1));
  return out;
}

std::string drawn(const HeatCell& cell, const svg::CellBox& box, const Layout& layout) {
  const double x = box.x + box.width / 2;
  const double y = box.y + box.height / 2 + 4;
  if (!cell.word.empty()) {
    return svg::filled(box, "#fff4e8") + svg::hatch(box, layout.categories.index(cell.word) % 5) +
           on_cell(x, y, "#6d2f00", layout.categories.initials(cell.word));
  }
  if (!std::isfinite(cell.value)) return "";
  const double share = layout.share(cell.value);
  return svg::filled(box, svg::shade(share)) +
         on_cell(x, y, share > 0.55 ? "#fff" : "#1d232b", fmt::format("{:.3g}", cell.value));
}

std::string cells(const HeatMap& map, const Layout& layout) {
  std::string out;
  for (std::size_t r = 0; r < std::min(map.y.size(), map.cells.size()); ++r) {
    for (std::size_t c = 0; c < std::min(map.x.size(), map.cells[r].size()); ++c) {
      out += drawn(map.cells[r][c],
                   {layout.left + layout.cell_width * double(c),
                    layout.bottom - kCell * double(r + 1), layout.cell_width, kCell},
                   layout);
    }
  }
  return out;
}

std::string names(const HeatMap& map, const Layout& layout) {
  std::string out = svg::text(6, 20, "start", "kh", map.title);
  for (std::size_t c = 0; c < map.x.size(); ++c)
    out += svg::text(layout.left + layout.cell_width * (double(c) + 0.5), layout.bottom + 16,
                     "middle", "kx", map.x[c]);
  for (std::size_t r = 0; r < map.y.size(); ++r)
    out += svg::text(layout.left - 6, layout.bottom - kCell * (double(r) + 0.5) + 4, "end", "ky",
                     map.y[r]);
  out += svg::text((layout.left + map.width_px - kRight) / 2, layout.bottom + 33, "middle", "",
                   map.x_label);
  return out + fmt::format("<g transform=\"translate(13 {:.1f}) rotate(-90)\">{}</g>\n",
                           (kTop + layout.bottom) / 2, svg::text(0, 0, "middle", "", map.y_label));
}

struct Legend {
  std::string drawing;
  double bottom = 0;
};

Legend legend(const HeatMap& map, const Layout& layout) {
  Legend out{"", layout.bottom + 44};
  double x = layout.left;
  const auto place = [&](double width) {
    if (x > layout.left && x + width > map.width_px - kRight)
      x = layout.left, out.bottom += kLegend;
    x += width;
    return svg::CellBox{x - width, out.bottom, 24, 15};
  };
  constexpr int kSteps = 5;
  for (int i = 0; i < kSteps && !layout.values.empty(); ++i) {
    const double share = double(i) / (kSteps - 1);
    const std::string words =
        fmt::format("{:.3g}", layout.range.low + share * (layout.range.high - layout.range.low));
    const svg::CellBox box = place(svg::text_width(words) + 44);
    out.drawing +=
        svg::filled(box, svg::shade(share)) + svg::text(box.x + 30, box.y + 12, "start", "", words);
  }
  if (!layout.values.empty() && !map.value_label.empty()) {
    const svg::CellBox box = place(svg::text_width(map.value_label) + 20);
    out.drawing += svg::text(box.x, box.y + 12, "start", "", map.value_label);
  }
  for (const std::string& word : layout.categories.words) {
    const std::string words = layout.categories.initials(word) + ": " + word;
    const svg::CellBox box = place(svg::text_width(words) + 44);
    out.drawing += svg::filled(box, "#fff4e8") +
                   svg::hatch(box, layout.categories.index(word) % 5) +
                   svg::text(box.x + 30, box.y + 12, "start", "", words);
  }
  out.bottom += kLegend;
  return out;
}

}  // namespace

std::string svg_heat_map(const HeatMap& map) {
  const Layout layout = layout_of(map);
  const Legend key = legend(map, layout);
  std::string body = names(map, layout) + cells(map, layout) + key.drawing;
  if (layout.values.empty() && layout.categories.words.empty())
    body += svg::text(map.width_px / 2, kTop + kCell / 2 + 4, "middle", "kn", map.when_empty);
  const std::string label = fmt::format("Map: {}. {} over {} and {}", map.title, map.value_label,
                                        map.x_label, map.y_label);
  return svg::document(map.width_px, key.bottom + 4, label, body);
}

}  // namespace kestrel
