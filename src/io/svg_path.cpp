#include "svg_path.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "svg_parts.hpp"

namespace kestrel::svg {
namespace {

struct Point {
  double x = 0;
  double y = 0;
};

std::string colour(int index) { return std::to_string(std::max(index, 0) % kColours); }

// First, lowest, highest and last of the points of one pixel column, in their order.
void append_extremes(const std::vector<Point>& column, std::vector<Point>& out) {
  const auto lower = [](const Point& a, const Point& b) { return a.y < b.y; };
  const auto [low, high] = std::minmax_element(column.begin(), column.end(), lower);
  std::set<std::ptrdiff_t> kept{0, low - column.begin(), high - column.begin(),
                                std::ptrdiff_t(column.size()) - 1};
  for (const std::ptrdiff_t i : kept) out.push_back(column[std::size_t(i)]);
}

std::vector<Point> thinned(const std::vector<Point>& points) {
  std::vector<Point> out;
  std::vector<Point> column;
  for (const Point& point : points) {
    if (!column.empty() && std::floor(point.x) != std::floor(column.front().x)) {
      append_extremes(column, out);
      column.clear();
    }
    column.push_back(point);
  }
  if (!column.empty()) append_extremes(column, out);
  return out;
}

// The unbroken stretches of a series, in pixels of the drawing.
std::vector<std::vector<Point>> stretches(const Series& series, const Axis& x, const Axis& y) {
  std::vector<std::vector<Point>> out(1);
  for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
    const Point point{x.at(series.x[i]), y.at(series.y[i])};
    if (std::isfinite(point.x) && std::isfinite(point.y))
      out.back().push_back(point);
    else if (!out.back().empty())
      out.emplace_back();
  }
  return out;
}

}  // namespace

std::string line_classes(const Series& series, std::size_t place) {
  std::string classes = "kl c" + colour(series.colour < 0 ? int(place) : series.colour);
  if (series.stroke == Stroke::Dashed) classes += " kd";
  if (series.stroke == Stroke::Faint) classes += " kz kd";
  if (series.stroke == Stroke::Dotted) classes += " kp";
  if (series.stroke == Stroke::DashDot) classes += " kq";
  return classes;
}

std::string path(const Series& series, std::size_t place, const Axis& x, const Axis& y) {
  std::string d;
  for (const auto& stretch : stretches(series, x, y)) {
    char verb = 'M';
    for (const Point& p : thinned(stretch)) {
      d += fmt::format("{}{:.1f} {:.1f}", verb, p.x, p.y);
      verb = 'L';
    }
    if (stretch.size() == 1) d += "h0";  // round caps make a dot of it
  }
  return d.empty() ? ""
                   : fmt::format("<path class=\"{}\" d=\"{}\"/>\n", line_classes(series, place), d);
}

std::string mark(const Mark& mark, double x, double y) {
  if (!std::isfinite(x) || !std::isfinite(y)) return "";
  if (mark.shape == Shape::Circle)
    return fmt::format("<circle class=\"kl c{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4.5\"/>\n",
                       colour(mark.colour), x, y);
  return fmt::format("<path class=\"kl c{0}\" d=\"M{1:.1f} {2:.1f}l10 10m0 -10l-10 10\"/>\n",
                     colour(mark.colour), x - 5, y - 5);
}

}  // namespace kestrel::svg
