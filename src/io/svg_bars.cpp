#include "kestrel/io/svg_bars.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "kestrel/io/axis.hpp"

#include "svg_parts.hpp"

namespace kestrel {
namespace {

constexpr double kTop = 32;
constexpr double kRow = 19;
constexpr double kBottom = 42;
constexpr double kValueWidth = 70;  // room for a bar's value beside it

/// Zero, the values and their intervals.
Axis axis_of(const BarChart& chart) {
  std::vector<double> all{0};
  double left = 0;
  bool is_negative = false;
  for (const Bar& bar : chart.bars) {
    all.insert(all.end(), {bar.value, bar.low, bar.high});
    left = std::max(left, svg::text_width(bar.name));
    is_negative = is_negative || bar.value < 0;
  }
  const double begin = std::min(left + 16, chart.width_px / 2);
  Range range = range_of(all, Spacing::Linear, 0);
  if (!(range.low < 0)) range.low = 0;
  if (!(range.high > 0)) range.high = 0;
  if (range.low == range.high) range = {0, 1};
  return {range, Spacing::Linear, begin + (is_negative ? kValueWidth : 0),
          chart.width_px - kValueWidth};
}

std::string grid(const BarChart& chart, const Axis& axis, double bottom) {
  std::string out;
  for (const Tick& tick : ticks(axis.range, Spacing::Linear, int((axis.end - axis.begin) / 70))) {
    const double x = axis.at(tick.value);
    out += svg::line(x, kTop, x, bottom, "kg");
    out += svg::text(x, bottom + 16, "middle", "kx", tick.label);
  }
  out += svg::text((axis.begin + axis.end) / 2, bottom + 34, "middle", "", chart.value_label);
  return out;
}

std::string interval(const Bar& bar, const Axis& axis, double middle) {
  if (!std::isfinite(bar.low) || !std::isfinite(bar.high)) return "";
  const double low = axis.at(bar.low);
  const double high = axis.at(bar.high);
  return fmt::format("<path class=\"kl c6\" d=\"M{0:.1f} {2:.1f}v8m0 -4H{1:.1f}m0 -4v8\"/>\n", low,
                     high, middle - 4);
}

std::string value_text(const Bar& bar, const Axis& axis, double middle) {
  const bool has_value = std::isfinite(bar.value);
  const std::string words =
      !bar.note.empty() ? bar.note : (has_value ? fmt::format("{:.3g}", bar.value) : "–");
  double end = axis.at(0);
  if (has_value) end = axis.at(bar.value);
  const bool is_left = has_value && bar.value < 0;
  for (const double reach : {bar.low, bar.high}) {
    if (!std::isfinite(reach)) continue;
    end = is_left ? std::min(end, axis.at(reach)) : std::max(end, axis.at(reach));
  }
  return svg::text(is_left ? end - 5 : end + 5, middle + 4, is_left ? "end" : "start", "kv", words);
}

std::string row(const Bar& bar, const Axis& axis, double middle) {
  const double zero = axis.at(0);
  std::string out = svg::text(6, middle + 4, "start", "kb", bar.name);
  if (std::isfinite(bar.value)) {
    const double end = axis.at(bar.value);
    out += fmt::format(
        "<rect class=\"b{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n",
        std::max(bar.colour, 0) % svg::kColours, std::min(zero, end), middle - 6,
        std::abs(end - zero), 12.);
  }
  return out + interval(bar, axis, middle) + value_text(bar, axis, middle);
}

}  // namespace

std::string svg_bars(const BarChart& chart) {
  const double bottom = kTop + kRow * double(std::max<std::size_t>(chart.bars.size(), 2));
  const Axis axis = axis_of(chart);
  std::string body = svg::text(6, 20, "start", "kh", chart.title) + grid(chart, axis, bottom);
  double middle = kTop + kRow / 2;
  for (const Bar& bar : chart.bars) {
    body += row(bar, axis, middle);
    middle += kRow;
  }
  body += svg::line(axis.at(0), kTop, axis.at(0), bottom, "kf");
  if (chart.bars.empty())
    body += svg::text(chart.width_px / 2, (kTop + bottom) / 2, "middle", "kn", chart.when_empty);
  const std::string label = fmt::format("Bars: {}. {}", chart.title, chart.value_label);
  return svg::document(chart.width_px, bottom + kBottom, label, body);
}

}  // namespace kestrel
