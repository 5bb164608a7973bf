#include "kestrel/io/svg_strip.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "kestrel/io/axis.hpp"

#include "svg_parts.hpp"

namespace kestrel {
namespace {

constexpr double kLane = 22;
constexpr double kTop = 34;
constexpr double kLeft = 112;
constexpr double kRight = 62;

// Where the last state ends: as long after its x as the states before it took on average.
double end_of(const std::vector<double>& x) {
  return x.size() < 2 ? x.back() + 1 : x.back() + (x.back() - x.front()) / double(x.size() - 1);
}

struct Bars {
  std::string drawing;
  std::size_t count = 0;  // of samples
};

Bars bars(const Strip& strip, std::size_t size, std::size_t lane, const Axis& axis) {
  Bars out;
  const double y = kTop + kLane * double(lane) + 3;
  for (std::size_t i = 0; i < size;) {
    std::size_t end = i + 1;
    while (end < size && strip.states[end] == strip.states[i]) ++end;
    if (strip.states[i] == strip.lanes[lane]) {
      const double from = axis.at(strip.x[i]);
      const double to = axis.at(end < strip.x.size() ? strip.x[end] : end_of(strip.x));
      out.count += end - i;
      if (std::isfinite(from) && std::isfinite(to))
        out.drawing += fmt::format(
            "<rect class=\"b{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n",
            lane % svg::kColours, from, y, std::max(to - from, 0.8), kLane - 6);
    }
    i = end;
  }
  return out;
}

std::string grid(const Axis& axis, double bottom) {
  std::string out;
  for (const Tick& tick : ticks(axis.range, Spacing::Linear, int((axis.end - axis.begin) / 70))) {
    const double x = axis.at(tick.value);
    out += svg::line(x, kTop, x, bottom, "kg");
    out += svg::text(x, bottom + 16, "middle", "kx", tick.label);
  }
  return out;
}

}  // namespace

std::string svg_strip(const Strip& strip) {
  const std::size_t size = std::min(strip.x.size(), strip.states.size());
  const double bottom = kTop + kLane * double(std::max<std::size_t>(strip.lanes.size(), 1));
  std::vector<double> xs = strip.x;
  if (size > 0) xs.push_back(end_of(strip.x));
  const Axis axis{range_of(xs, Spacing::Linear, 0), Spacing::Linear, kLeft,
                  strip.width_px - kRight};
  std::string body = svg::text(kLeft, 20, "start", "kh", strip.title) + grid(axis, bottom);
  for (std::size_t lane = 0; lane < strip.lanes.size(); ++lane) {
    const Bars drawn = bars(strip, size, lane, axis);
    const double y = kTop + kLane * double(lane) + 15;
    body += svg::text(kLeft - 8, y, "end", "", strip.lanes[lane]) + drawn.drawing;
    if (size > 0)
      body += svg::text(strip.width_px - kRight + 6, y, "start", "kn",
                        fmt::format("{:.1f} %", 100. * double(drawn.count) / double(size)));
  }
  if (size == 0)
    body += svg::text((axis.begin + axis.end) / 2, (kTop + bottom) / 2 + 4, "middle", "kn",
                      "no values to show");
  body += fmt::format(
      "<rect class=\"kf\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
      "height=\"{:.1f}\"/>\n",
      axis.begin, kTop, axis.end - axis.begin, bottom - kTop);
  body += svg::text((axis.begin + axis.end) / 2, bottom + 34, "middle", "", strip.x_label);
  return svg::document(strip.width_px, bottom + 42, "Time line: " + strip.title, body);
}

}  // namespace kestrel
