#pragma once

#include <optional>
#include <vector>

namespace kestrel {

/// How a list of numbers lies. The median of an even count is the mean of the middle two; the 95 %
/// point is the smallest number that at least 95 % of them do not exceed (nearest rank).
struct Spread {
  int count = 0;
  double mean = 0;
  double median = 0;
  double p95 = 0;
  double max = 0;
};

/// The spread of these numbers, which must not be NaN; empty for none.
std::optional<Spread> spread_of(std::vector<double> numbers);

}  // namespace kestrel
