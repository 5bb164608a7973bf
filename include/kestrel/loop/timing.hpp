#pragma once

#include <optional>

#include "kestrel/vehicle/dead_reckoning.hpp"

namespace kestrel {

/// Over which latency the features are predicted.
enum class Prediction {
  Off,
  Measured,   // where the source tells the vehicle's velocity; not where it does not
  Commanded,  // also without: from what the vehicle was told alone
};

/// What the loop does about its own timing.
struct TimingOptions {
  Prediction predict = Prediction::Off;
  double gain_share = 0.25;           // the most that the gain may be of gain_limit_per_s()
  std::optional<double> latency_s{};  // capture to command obeyed; empty: as it is measured
  VelocityResponse response{};

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// How fast the loop has been lately.
struct LoopTiming {
  std::optional<double> period_s;   // from frame to frame
  std::optional<double> latency_s;  // from the capture of a frame to its command; empty: unknown
};

/// The same after another period or latency: an average in which a value counts for 1/8 when it is
/// new, the first for all. Left out are values that are not finite, periods that are not positive,
/// and latencies outside 0 to 10 s.
LoopTiming with_period(LoopTiming timing, double period_s);
LoopTiming with_latency(LoopTiming timing, double latency_s);

/// The latency that counts: the option's, else the measured one; empty when neither is known.
std::optional<double> latency_s(const LoopTiming& timing, const TimingOptions& options);

/// The largest gain (1/s) the loop may have: a share of its limit. The latency counts in full even
/// where it is predicted over: a prediction is a model. Empty while period or latency are unknown.
std::optional<double> largest_gain_per_s(const LoopTiming& timing, const TimingOptions& options);

/// "off", "measured", "commanded".
const char* name(Prediction prediction);

}  // namespace kestrel
