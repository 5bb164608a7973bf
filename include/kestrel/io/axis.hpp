#pragma once

#include <string>
#include <vector>

namespace kestrel {

/// How numbers lie along an axis.
enum class Spacing { Linear, Logarithmic };

/// Numbers from `low` to `high`, low < high; positive if logarithmic.
struct Range {
  double low = 0;
  double high = 1;
};

/// A place on an axis and what is written there.
struct Tick {
  double value = 0;
  std::string label;
};

/// The smallest range that holds the finite (logarithmic: finite and positive) values with a margin
/// of `margin` of its length on both sides; widened about a single value; 0..1 (logarithmic: 1..10)
/// for no value at all.
Range range_of(const std::vector<double>& values, Spacing spacing, double margin);

/// About `count` round numbers inside the range: 1, 2 or 5 times a power of ten apart, or for a
/// logarithmic axis whole powers of ten (with 2 and 5 times these when there are few). Empty for a
/// range that is none (low >= high, not finite, or for a
/// logarithmic axis not positive).
std::vector<Tick> ticks(const Range& range, Spacing spacing, int count);

/// A range of numbers laid along a drawing from pixel `begin` (range.low) to pixel `end`.
struct Axis {
  Range range;
  Spacing spacing = Spacing::Linear;
  double begin = 0;
  double end = 1;

  /// Where a value lies, px; not finite where it has no place (NaN; not positive on a logarithmic
  /// axis).
  double at(double value) const;
};

}  // namespace kestrel
