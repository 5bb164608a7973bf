#include "kestrel/loop/timing.hpp"

#include <cmath>
#include <stdexcept>

#include "kestrel/vehicle/gain_limit.hpp"

namespace kestrel {
namespace {

constexpr double kWeightOfNew = 0.125;
constexpr double kLongestLatency_s = 10;  // what is older is a wrong clock

std::optional<double> averaged(const std::optional<double>& before, double value) {
  return before ? *before + kWeightOfNew * (value - *before) : value;
}

}  // namespace

void TimingOptions::check() const {
  if (!(std::isfinite(gain_share) && gain_share > 0)) {
    throw std::invalid_argument("gain_share: must be positive and finite");
  }
  if (latency_s && !(*latency_s >= 0 && *latency_s <= kLongestLatency_s)) {
    throw std::invalid_argument("latency_s: must be from 0 to 10");
  }
  response.check();
}

LoopTiming with_period(LoopTiming timing, double period_s) {
  if (std::isfinite(period_s) && period_s > 0) {
    timing.period_s = averaged(timing.period_s, period_s);
  }
  return timing;
}

LoopTiming with_latency(LoopTiming timing, double latency_s) {
  if (latency_s >= 0 && latency_s <= kLongestLatency_s) {
    timing.latency_s = averaged(timing.latency_s, latency_s);
  }
  return timing;
}

std::optional<double> latency_s(const LoopTiming& timing, const TimingOptions& options) {
  return options.latency_s ? options.latency_s : timing.latency_s;
}

std::optional<double> largest_gain_per_s(const LoopTiming& timing, const TimingOptions& options) {
  const std::optional<double> latency = latency_s(timing, options);
  if (!timing.period_s || !latency) return std::nullopt;
  return options.gain_share * gain_limit_per_s(*timing.period_s, *latency, options.response);
}

const char* name(Prediction prediction) {
  switch (prediction) {
    case Prediction::Off:
      return "off";
    case Prediction::Measured:
      return "measured";
    case Prediction::Commanded:
      return "commanded";
  }
  return "unknown";
}

}  // namespace kestrel
