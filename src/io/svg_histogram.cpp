#include "kestrel/io/svg_histogram.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "kestrel/io/svg_plot.hpp"

namespace kestrel {
namespace {

constexpr double kBins = 40;
constexpr double kMaxBins = 1e5;

/// The finite ones, in their order by size.
std::vector<double> sorted(const std::vector<double>& values) {
  std::vector<double> finite;
  std::copy_if(values.begin(), values.end(), std::back_inserter(finite),
               [](double value) { return std::isfinite(value); });
  std::sort(finite.begin(), finite.end());
  return finite;
}

/// The least of 1, 2 and 5 times a power of ten that is not below the value.
double round_up(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (digit * power >= value * (1 - 1e-9)) return digit * power;
  }
  return 10 * power;
}

/// Where values are drawn, and in what bins.
struct View {
  double low = 0;
  double high = 0;
  double width = 1;
};

View view_of(const std::vector<double>& values) {
  const auto at = [&](double share) {
    return values[std::size_t(share * double(values.size() - 1))];
  };
  const double low = at(0.01);
  const double high = at(0.99);
  const double span = high > low ? high - low : std::max(1e-3, std::abs(high) * 0.1);
  return {low - 1.5 * span, high + 1.5 * span, round_up(span / kBins)};
}

/// The outline of the bins, from the ground to the ground.
Series stairs(const std::vector<HistogramBin>& bins, double width) {
  Series line;
  const auto to = [&](double x, double y) {
    line.x.push_back(x);
    line.y.push_back(y);
  };
  for (const HistogramBin& bin : bins) {
    if (line.x.empty()) to(bin.low, 0);
    to(bin.low, double(bin.count));
    to(bin.low + width, double(bin.count));
  }
  if (!line.x.empty()) to(line.x.back(), 0);
  return line;
}

}  // namespace

std::vector<HistogramBin> histogram_bins(const std::vector<double>& values, double width) {
  if (!(std::isfinite(width) && width > 0)) {
    throw std::invalid_argument("width: must be positive and finite");
  }
  const std::vector<double> finite = sorted(values);
  if (finite.empty()) return {};
  const double first = std::floor(finite.front() / width);
  const double last = std::floor(finite.back() / width);
  if (!(last - first < kMaxBins))
    throw std::invalid_argument("width: is too narrow for the values");
  std::vector<HistogramBin> bins(std::size_t(last - first) + 1);
  for (std::size_t i = 0; i < bins.size(); ++i) bins[i].low = (first + double(i)) * width;
  for (const double value : finite) {
    const double place = std::floor(value / width) - first;
    ++bins[std::size_t(std::clamp(place, 0.0, last - first))].count;
  }
  return bins;
}

std::string svg_histogram(const Histogram& histogram) {
  Plot plot;
  plot.title = histogram.title;
  plot.x_label = histogram.value_label;
  plot.y_label = "count";
  plot.when_empty = histogram.when_empty;
  plot.height_px = 250;
  const std::vector<double> values = sorted(histogram.values);
  if (values.empty()) return svg_plot(plot);
  const View view = view_of(values);
  std::vector<double> drawn;
  std::copy_if(values.begin(), values.end(), std::back_inserter(drawn),
               [&](double value) { return value >= view.low && value <= view.high; });
  if (drawn.size() < values.size()) {
    plot.title +=
        fmt::format(" ({} of {} lie outside, {:.4g} to {:.4g})", values.size() - drawn.size(),
                    values.size(), values.front(), values.back());
  }
  plot.series = {stairs(histogram_bins(drawn, view.width), view.width)};
  return svg_plot(plot);
}

}  // namespace kestrel
