#include "kestrel/eval/spread.hpp"

#include <algorithm>
#include <numeric>

namespace kestrel {

std::optional<Spread> spread_of(std::vector<double> numbers) {
  if (numbers.empty()) return std::nullopt;
  std::sort(numbers.begin(), numbers.end());
  const std::size_t count = numbers.size();
  const std::size_t half = count / 2;
  Spread spread;
  spread.count = int(count);
  spread.mean = std::accumulate(numbers.begin(), numbers.end(), 0.0) / double(count);
  spread.median = count % 2 == 1 ? numbers[half] : (numbers[half - 1] + numbers[half]) / 2;
  spread.p95 = numbers[(count * 95 + 99) / 100 - 1];
  spread.max = numbers.back();
  return spread;
}

}  // namespace kestrel
