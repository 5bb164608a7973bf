#include "kestrel/io/axis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace kestrel {
namespace {

bool has_place(double value, Spacing spacing) {
  return std::isfinite(value) && (spacing == Spacing::Linear || value > 0);
}

Range widened(const Range& range, double margin) {
  // Of numbers beyond this a difference or a margin would overflow.
  const double largest = std::numeric_limits<double>::max() / 1e4;
  const double low = std::clamp(range.low, -largest, largest);
  const double high = std::clamp(range.high, -largest, largest);
  const double length = high - low;
  const double size = std::max(std::abs(low), std::abs(high));
  if (!(length > 1e-12 * size) || length < 1e-300) {
    const double half = size > 1e-300 ? 0.1 * size : 0.5;
    return {low - half, high + half};
  }
  return {low - margin * length, high + margin * length};
}

Range logarithmic_range(const Range& range, double margin) {
  Range decades{std::log10(range.low), std::log10(range.high)};
  const double missing = 1 - (decades.high - decades.low);
  if (missing > 0) decades = {decades.low - missing / 2, decades.high + missing / 2};
  const double length = decades.high - decades.low;
  return {std::pow(10, std::max(decades.low - margin * length, -307.)),
          std::pow(10, std::min(decades.high + margin * length, 308.))};
}

std::string superscript(int exponent) {
  static constexpr const char* kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(exponent))) text += kDigits[digit - '0'];
  return text;
}

std::string power_label(int mantissa, int exponent) {
  if (std::abs(exponent) <= 2) return fmt::format("{:g}", mantissa * std::pow(10, exponent));
  const std::string power = "10" + superscript(exponent);
  return mantissa == 1 ? power : fmt::format("{}·{}", mantissa, power);
}

std::vector<Tick> logarithmic_ticks(const Range& range, int count) {
  const int low = int(std::floor(std::log10(range.low)));
  const int high = int(std::ceil(std::log10(range.high)));
  const int stride = std::max(1, (high - low + count - 1) / count);
  const std::vector<int> mantissas = high - low <= 3 ? std::vector{1, 2, 5} : std::vector{1};
  std::vector<Tick> out;
  for (int exponent = low; exponent <= high; ++exponent) {
    if (exponent % stride != 0) continue;
    for (const int mantissa : mantissas) {
      const double value = mantissa * std::pow(10, exponent);
      if (value >= range.low && value <= range.high)
        out.push_back({value, power_label(mantissa, exponent)});
    }
  }
  return out;
}

// The step 1, 2 or 5 times a power of ten nearest (by ratio) to the one asked for.
double round_step(double wanted) {
  const double power = std::pow(10, std::floor(std::log10(wanted)));
  const double mantissa = wanted / power;
  return power * (mantissa < std::sqrt(2)    ? 1
                  : mantissa < std::sqrt(10) ? 2
                  : mantissa < std::sqrt(50) ? 5
                                             : 10);
}

}  // namespace

Range range_of(const std::vector<double>& values, Spacing spacing, double margin) {
  const bool logarithmic = spacing == Spacing::Logarithmic;
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const double value : values) {
    if (!has_place(value, spacing)) continue;
    range = {std::min(range.low, value), std::max(range.high, value)};
  }
  if (range.low > range.high) return logarithmic ? Range{1, 10} : Range{0, 1};
  return logarithmic ? logarithmic_range(range, margin) : widened(range, margin);
}

std::vector<Tick> ticks(const Range& range, Spacing spacing, int count) {
  if (!(range.low < range.high) || !std::isfinite(range.high - range.low)) return {};
  if (!has_place(range.low, spacing)) return {};
  if (spacing == Spacing::Logarithmic) return logarithmic_ticks(range, count);
  const double step = round_step((range.high - range.low) / std::max(count, 1));
  const int decimals = std::max(0, -int(std::floor(std::log10(step) + 1e-9)));
  const double size = std::max(std::abs(range.low), std::abs(range.high));
  std::vector<Tick> out;
  for (double k = std::ceil(range.low / step - 1e-9); k * step <= range.high + 1e-9 * step; ++k) {
    const double value = k * step;
    const double shown = value == 0 ? 0. : value;  // no "-0"
    out.push_back({value, size >= 1e5 || decimals > 4 ? fmt::format("{:.6g}", shown)
                                                      : fmt::format("{:.{}f}", shown, decimals)});
    if (out.size() > 100) break;  // a step lost in rounding would never reach the end
  }
  return out;
}

double Axis::at(double value) const {
  if (!has_place(value, spacing)) return std::numeric_limits<double>::quiet_NaN();
  const auto along = [&](double x) { return spacing == Spacing::Linear ? x : std::log10(x); };
  const double low = along(range.low);
  return begin + (end - begin) * ((along(value) - low) / (along(range.high) - low));
}

}  // namespace kestrel
