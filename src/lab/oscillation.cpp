#include "oscillation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace kestrel {
namespace {

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.) / double(values.size());
}

double rms(const std::vector<double>& values, double about, std::size_t from, std::size_t to) {
  double sum = 0;
  for (std::size_t i = from; i < to; ++i) sum += (values[i] - about) * (values[i] - about);
  return std::sqrt(sum / double(std::max<std::size_t>(1, to - from)));
}

/// When the signal rose through the band: it was below, then above.
std::vector<double> rises(const std::vector<double>& times_s, const std::vector<double>& values,
                          double middle, double half_band) {
  std::vector<double> found;
  bool below = false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] < middle - half_band) below = true;
    if (!below || values[i] < middle + half_band) continue;
    found.push_back(times_s[i]);
    below = false;
  }
  return found;
}

}  // namespace

std::optional<Oscillation> oscillation(const std::vector<double>& times_s,
                                       const std::vector<double>& values) {
  if (values.size() < 12 || times_s.size() != values.size()) return std::nullopt;
  const double middle = mean(values);
  const double size = rms(values, middle, 0, values.size());
  if (!(size > 0)) return std::nullopt;
  const std::vector<double> up = rises(times_s, values, middle, size / 2);
  if (up.size() < 3) return std::nullopt;
  std::vector<double> periods_s;
  for (std::size_t i = 1; i < up.size(); ++i) periods_s.push_back(up[i] - up[i - 1]);
  std::sort(periods_s.begin(), periods_s.end());
  const double period_s = periods_s[periods_s.size() / 2];
  if (periods_s.back() > 2 * period_s) return std::nullopt;
  const std::size_t half = values.size() / 2;
  const double late = rms(values, middle, half, values.size());
  return Oscillation{period_s, late, late / rms(values, middle, 0, half)};
}

}  // namespace kestrel
