#include "kestrel/io/svg_plot.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "svg_line_ends.hpp"
#include "svg_parts.hpp"
#include "svg_path.hpp"

namespace kestrel {
namespace {

constexpr double kLeft = 62;
constexpr double kRight = 14;
constexpr double kBottom = 42;
constexpr double kRow = 17;  // height of a row of the legend

struct Legend {
  std::string drawing;
  double height = 0;
};

Legend legend(const Plot& plot) {
  Legend out;
  double x = kLeft;
  double y = 44;
  const auto place = [&](const std::string& name) {  // left end of the entry's symbol
    const double width = svg::text_width(name) + 40;
    if (x > kLeft && x + width > plot.width_px - kRight) x = kLeft, y += kRow;
    out.height = y - 44 + kRow;
    out.drawing += svg::text(x + 28, y, "start", "", name);
    x += width;
    return x - width;
  };
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    if (plot.series[i].name.empty() || plot.names == Plot::Names::LineEnds) continue;
    const double at = place(plot.series[i].name);
    out.drawing += svg::line(at, y - 4, at + 22, y - 4, svg::line_classes(plot.series[i], i));
  }
  std::set<std::string> named{""};
  for (const Mark& mark : plot.marks) {
    if (!named.insert(mark.name).second) continue;
    const double at = place(mark.name);
    Mark neutral = mark;
    neutral.colour = 6;
    out.drawing += svg::mark(neutral, at + 14, y - 4);
  }
  return out;
}

struct Axes {
  Axis x;
  Axis y;
  bool empty = true;
  std::vector<Limit> drawn;
  std::vector<Limit> beyond;
};

void make_equal(Axes& axes) {
  const auto span = [](const Axis& a) { return a.range.high - a.range.low; };
  const auto size = [](const Axis& a) { return std::abs(a.end - a.begin); };
  const double unit = std::max(span(axes.x) / size(axes.x), span(axes.y) / size(axes.y));
  for (Axis* axis : {&axes.x, &axes.y}) {
    const double middle = (axis->range.low + axis->range.high) / 2;
    axis->range = {middle - unit * size(*axis) / 2, middle + unit * size(*axis) / 2};
  }
}

Axes axes_of(const Plot& plot, double top) {
  std::vector<double> xs;
  std::vector<double> ys;
  Axes out;
  const auto add = [&](double x, double y) {
    const bool has_place = plot.y_spacing == Spacing::Linear || y > 0;
    if (!std::isfinite(x) || !std::isfinite(y) || !has_place) return;
    xs.push_back(x);
    ys.push_back(y);
  };
  for (const Series& series : plot.series)
    for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i)
      add(series.x[i], series.y[i]);
  for (const Mark& mark : plot.marks) add(mark.x, mark.y);
  out.empty = xs.empty();
  const Range near = range_of(ys, plot.y_spacing, 1.5);
  for (const Limit& limit : plot.limits) {
    const bool is_near = out.empty || (limit.y >= near.low && limit.y <= near.high);
    (is_near ? out.drawn : out.beyond).push_back(limit);
    if (is_near) ys.push_back(limit.y);
  }
  const bool free = plot.axes == Plot::Axes::Free || plot.y_spacing == Spacing::Logarithmic;
  out.x = {range_of(xs, Spacing::Linear, free ? 0.01 : 0.05), Spacing::Linear, kLeft,
           plot.width_px - kRight - svg::line_end_width(plot)};
  out.y = {range_of(ys, plot.y_spacing, 0.06), plot.y_spacing, plot.height_px - kBottom, top};
  if (!free) make_equal(out);
  if (plot.axes == Plot::Axes::EqualDown) std::swap(out.y.begin, out.y.end);
  return out;
}

std::string grid(const Plot& plot, const Axes& axes) {
  const double left = axes.x.begin;
  const double right = axes.x.end;
  const double bottom = plot.height_px - kBottom;
  const double top = std::min(axes.y.begin, axes.y.end);
  std::string out;
  for (const Tick& tick : ticks(axes.x.range, Spacing::Linear, int((right - left) / 70))) {
    const double x = axes.x.at(tick.value);
    out += svg::line(x, top, x, bottom, "kg");
    out += svg::text(x, bottom + 16, "middle", "kx", tick.label);
  }
  for (const Tick& tick : ticks(axes.y.range, axes.y.spacing, int((bottom - top) / 36))) {
    const double y = axes.y.at(tick.value);
    out += svg::line(left, y, right, y, "kg");
    out += svg::text(left - 6, y + 4, "end", "ky", tick.label);
  }
  return out + fmt::format(
                   "<rect class=\"kf\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
                   "height=\"{:.1f}\"/>\n",
                   left, top, right - left, bottom - top);
}

std::string labels(const Plot& plot, double top) {
  const double middle = (top + plot.height_px - kBottom) / 2;
  return svg::text(kLeft, 20, "start", "kh", plot.title) +
         svg::text((kLeft + plot.width_px - kRight - svg::line_end_width(plot)) / 2,
                   plot.height_px - 8, "middle", "", plot.x_label) +
         fmt::format("<g transform=\"translate(13 {:.1f}) rotate(-90)\">{}</g>\n", middle,
                     svg::text(0, 0, "middle", "", plot.y_label));
}

std::string limit_lines(const Axes& axes) {
  std::string out;
  for (const Limit& limit : axes.drawn) {
    const double y = axes.y.at(limit.y);
    if (!std::isfinite(y)) continue;
    out += svg::line(axes.x.begin, y, axes.x.end, y, "km");
    out += svg::text(axes.x.end - 4, y - 4, "end", "kr", limit.label);
  }
  return out;
}

std::string notes(const Plot& plot, const Axes& axes, double top) {
  std::string beyond;
  for (const Limit& limit : axes.beyond)
    beyond +=
        fmt::format("{}{} {:.4g}", beyond.empty() ? "not drawn: " : ", ", limit.label, limit.y);
  std::string out;
  if (!beyond.empty()) out += svg::text(plot.width_px - kRight, 20, "end", "kn", beyond);
  if (axes.empty)
    out += svg::text((axes.x.begin + axes.x.end) / 2, (top + plot.height_px - kBottom) / 2,
                     "middle", "kn", plot.when_empty);
  return out;
}

}  // namespace

std::string svg_plot(const Plot& plot) {
  const Legend names = legend(plot);
  const double top = 34 + names.height;
  const Axes axes = axes_of(plot, top);
  std::string body = labels(plot, top) + notes(plot, axes, top) + grid(plot, axes) + names.drawing;
  body += limit_lines(axes);
  for (std::size_t i = 0; i < plot.series.size(); ++i)
    body += svg::path(plot.series[i], i, axes.x, axes.y);
  if (plot.names == Plot::Names::LineEnds) body += svg::line_ends(plot, axes.x, axes.y);
  for (const Mark& mark : plot.marks) body += svg::mark(mark, axes.x.at(mark.x), axes.y.at(mark.y));
  const std::string label =
      fmt::format("Plot: {}. {} over {}", plot.title, plot.y_label, plot.x_label);
  return svg::document(plot.width_px, plot.height_px, label, body);
}

}  // namespace kestrel
