#pragma once

#include <optional>
#include <vector>

namespace kestrel {

/// A swing that goes on.
struct Oscillation {
  double period_s = 0;
  double amplitude = 0;  // root mean square about the mean, in the second half of the stretch
  double growth = 0;     // that over the same of the first half
};

/// The swing of a signal about its mean: at least two whole periods, by the crossings of a band of
/// half its root mean square (so that noise about the mean does not count), as regular as a swing
/// is: no period more than twice the median. Empty when there is none.
std::optional<Oscillation> oscillation(const std::vector<double>& times_s,
                                       const std::vector<double>& values);

}  // namespace kestrel
