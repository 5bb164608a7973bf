#include "svg_cell.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace kestrel::svg {

std::string shade(double share) {
  constexpr double kStops[3][3] = {{249, 243, 200}, {62, 165, 152}, {18, 46, 100}};
  const double place = std::clamp(share, 0., 1.) * 2;
  const int from = place < 1 ? 0 : 1;
  const auto mixed = [&](int c) {
    return int(
        std::lround(kStops[from][c] + (kStops[from + 1][c] - kStops[from][c]) * (place - from)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", mixed(0), mixed(1), mixed(2));
}

std::string filled(const CellBox& box, const std::string& colour) {
  return fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\" "
      "stroke=\"#9aa3ae\" stroke-width=\".5\"/>\n",
      box.x, box.y, box.width, box.height, colour);
}

std::string hatch(const CellBox& box, int kind) {
  constexpr double kGap = 7;
  const double h = box.height;
  std::string d;
  for (double x = kind < 2 || kind == 4 ? -h : kGap / 2; x < box.width; x += kGap) {
    const double cut = std::max(-x, 0.);                  // begins left of the box
    const double over = std::max(x + h - box.width, 0.);  // ends right of it
    if (kind == 0 || kind == 4)
      d += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", box.x + x + cut, box.y + h - cut,
                       box.x + x + h - over, box.y + over);
    if (kind == 1 || kind == 4)
      d += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", box.x + x + cut, box.y + cut,
                       box.x + x + h - over, box.y + h - over);
    if (kind == 2) d += fmt::format("M{:.1f} {:.1f}v{:.1f}", box.x + x, box.y, h);
  }
  for (double y = kGap / 2; kind == 3 && y < h; y += kGap)
    d += fmt::format("M{:.1f} {:.1f}h{:.1f}", box.x, box.y + y, box.width);
  return fmt::format("<path d=\"{}\" stroke=\"#8f4a12\" stroke-width=\"1\" fill=\"none\"/>\n", d);
}

}  // namespace kestrel::svg
