#include "kestrel/io/svg_space.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "kestrel/io/axis.hpp"

#include "svg_free_words.hpp"
#include "svg_parts.hpp"
#include "svg_path.hpp"

namespace kestrel {
namespace {

constexpr double kEdge = 14;
constexpr double kRow = 17;
constexpr double kFoot = 30;  // for the scale bar

struct Sheet {
  Axis x;
  Axis y;
  double px_per_m = 0;
  double top = 0;
  bool empty = true;
};

struct Legend {
  std::string drawing;
  double height = 0;
};

Legend legend(const SpacePlot& plot) {
  Legend out;
  double x = kEdge;
  double y = 42;
  for (std::size_t i = 0; i < plot.lines.size(); ++i) {
    const SpaceLine& line = plot.lines[i];
    if (line.name.empty()) continue;
    const double width = svg::text_width(line.name) + 40;
    if (x > kEdge && x + width > plot.width_px - kEdge) x = kEdge, y += kRow;
    const Series style{line.name, {}, {}, line.colour, line.stroke};
    out.drawing += svg::line(x, y - 4, x + 22, y - 4, svg::line_classes(style, i)) +
                   svg::text(x + 28, y, "start", "", line.name);
    out.height = y - 42 + kRow;
    x += width;
  }
  return out;
}

Sheet sheet_of(const SpacePlot& plot, double top) {
  std::vector<double> xs;
  std::vector<double> ys;
  const auto add = [&](const Eigen::Vector3d& point_m) {
    const Eigen::Vector2d at = projected(plot.view, point_m);
    if (!at.allFinite()) return;
    xs.push_back(at.x());
    ys.push_back(at.y());
  };
  for (const SpaceLine& line : plot.lines) {
    if (line.fit == SpaceLine::Fit::Cut) continue;
    for (const Eigen::Vector3d& point_m : line.points_m) add(point_m);
  }
  for (const SpaceFrame& frame : plot.frames) add(frame.origin_m);
  Sheet out;
  out.empty = xs.empty();
  out.top = top;
  out.x = {range_of(xs, Spacing::Linear, 0.08), Spacing::Linear, kEdge, plot.width_px - kEdge};
  out.y = {range_of(ys, Spacing::Linear, 0.08), Spacing::Linear, plot.height_px - kFoot, top};
  const auto span = [](const Axis& a) { return a.range.high - a.range.low; };
  const auto size = [](const Axis& a) { return std::abs(a.end - a.begin); };
  const double unit = std::max(span(out.x) / size(out.x), span(out.y) / size(out.y));
  for (Axis* axis : {&out.x, &out.y}) {
    const double middle = (axis->range.low + axis->range.high) / 2;
    axis->range = {middle - unit * size(*axis) / 2, middle + unit * size(*axis) / 2};
  }
  out.px_per_m = 1 / unit;
  return out;
}

std::string line(const SpacePlot& plot, std::size_t place, const Sheet& sheet) {
  const SpaceLine& one = plot.lines[place];
  Series series{one.name, {}, {}, one.colour, one.stroke};
  for (const Eigen::Vector3d& point_m : one.points_m) {
    const Eigen::Vector2d at = projected(plot.view, point_m);
    series.x.push_back(at.x());
    series.y.push_back(at.y());
  }
  return svg::path(series, place, sheet.x, sheet.y);
}

/// The axes, 34 px long in space; those that point at the eye look shorter. Where frames fall on
/// one another the words of the later one stand farther out.
std::string frame(const SpacePlot& plot, const SpaceFrame& one, const Sheet& sheet,
                  svg::FreeWords& words) {
  constexpr double kLength_px = 34;
  const Eigen::Vector2d origin = projected(plot.view, one.origin_m);
  if (!origin.allFinite() || !one.axes.allFinite()) return "";
  const Eigen::Vector2d at(sheet.x.at(origin.x()), sheet.y.at(origin.y()));
  std::string out;
  for (int i = 0; i < 3; ++i) {
    Eigen::Vector2d along = projected(plot.view, one.axes.col(i).normalized()) * kLength_px;
    along.y() = -along.y();
    const Eigen::Vector2d tip = at + along;
    out += svg::line(at.x(), at.y(), tip.x(), tip.y(), "kl c6");
    if (along.norm() < 8) continue;
    const std::string letter(1, "xyz"[i]);
    const Eigen::Vector2d below(0, 4);
    const Eigen::Vector2d step = along.normalized() * 14;
    const Eigen::Vector2d first = at + 1.25 * along + below;
    const Eigen::Vector2d free = words.place(letter, {first, first + step, first + 2 * step});
    out += svg::text(free.x(), free.y(), "middle", "kn", letter);
  }
  const Eigen::Vector2d first = at + Eigen::Vector2d(8 + svg::text_width(one.name) / 2, 18);
  const Eigen::Vector2d row(0, 14);
  const Eigen::Vector2d free =
      words.place(one.name, {first, first + row, first + 2 * row, first + 3 * row});
  return out + svg::text(free.x(), free.y(), "middle", "", one.name);
}

/// A bar of 1, 2 or 5 times a power of ten metres, about a sixth of the width.
std::string scale_bar(const SpacePlot& plot, const Sheet& sheet) {
  const double wanted_m = plot.width_px / 6 / sheet.px_per_m;
  const double power = std::pow(10, std::floor(std::log10(wanted_m)));
  const double mantissa = wanted_m / power;
  const double length_m = power * (mantissa < 2 ? 1 : mantissa < 5 ? 2 : 5);
  const double y = plot.height_px - 12;
  return fmt::format("<path class=\"kl c6\" d=\"M{:.1f} {:.1f}v8m0 -4h{:.1f}m0 -4v8\"/>\n", kEdge,
                     y - 4, length_m * sheet.px_per_m) +
         svg::text(kEdge + length_m * sheet.px_per_m + 8, y + 4, "start", "ks",
                   fmt::format("{:g} m", length_m));
}

/// What is drawn inside, cut at the border.
std::string cut(const SpacePlot& plot, double top, const std::string& body) {
  const double width = plot.width_px;
  const double height = plot.height_px - kFoot - top;
  return fmt::format(
      "<svg x=\"0\" y=\"{0:.1f}\" width=\"{1:.1f}\" height=\"{2:.1f}\" "
      "viewBox=\"0 {0:.1f} {1:.1f} {2:.1f}\">\n{3}</svg>\n",
      top, width, height, body);
}

}  // namespace

Eigen::Vector2d projected(const SpaceView& view, const Eigen::Vector3d& point_m) {
  const Eigen::Vector3d eye = view.towards_eye.normalized();
  const Eigen::Vector3d right = (-eye).cross(view.up).normalized();
  return {right.dot(point_m), right.cross(-eye).dot(point_m)};
}

std::string svg_space(const SpacePlot& plot) {
  const Legend names = legend(plot);
  const double top = 30 + names.height;
  const Sheet sheet = sheet_of(plot, top);
  std::string inside;
  for (std::size_t i = 0; i < plot.lines.size(); ++i) inside += line(plot, i, sheet);
  svg::FreeWords words;
  for (const SpaceFrame& one : plot.frames) inside += frame(plot, one, sheet, words);
  std::string body = svg::text(kEdge, 20, "start", "kh", plot.title) + names.drawing;
  if (sheet.empty) {
    body +=
        svg::text(plot.width_px / 2, (top + plot.height_px) / 2, "middle", "kn", plot.when_empty);
  } else {
    body += cut(plot, top, inside) + scale_bar(plot, sheet);
  }
  return svg::document(plot.width_px, plot.height_px, "Paths in space: " + plot.title, body);
}

}  // namespace kestrel
