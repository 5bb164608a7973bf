#include "kestrel/io/live_options.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace kestrel {
namespace {

void require(bool good, const std::string& what) {
  if (!good) throw std::invalid_argument(what);
}

void require_positive(const char* key, const char* unit, double value) {
  require(std::isfinite(value) && value > 0,
          std::string(key) + ": must be positive and finite (" + unit + ")");
}

void check_trigger(const TriggerSettings& t) {
  constexpr std::array<const char*, 5> kSources = {"0", "1", "2", "3", "software"};
  constexpr std::array<int, 8> kModes = {0, 1, 2, 3, 4, 5, 14, 15};
  require(std::find(kSources.begin(), kSources.end(), t.source) != kSources.end(),
          "trigger.source: must be 0, 1, 2, 3 or software");
  require(std::find(kModes.begin(), kModes.end(), t.mode) != kModes.end(),
          "trigger.mode: must be 0 to 5, 14 or 15");
  require(t.polarity.empty() || t.polarity == "high" || t.polarity == "low",
          "trigger.polarity: must be high or low");
}

void check_capture(const CaptureSettings& c) {
  if (c.size) require(c.size->width > 0 && c.size->height > 0, "size_px: must be positive (px)");
  if (c.rate_hz) require_positive("rate_hz", "1/s", *c.rate_hz);
  if (c.exposure_s) require_positive("exposure_s", "s", *c.exposure_s);
  if (c.gain) require(std::isfinite(*c.gain) && *c.gain >= 0, "gain: must be 0 or more");
  if (c.trigger) check_trigger(*c.trigger);
}

}  // namespace

bool CaptureSettings::is_empty() const {
  return format.empty() && !size && !rate_hz && !exposure_s && !gain && !trigger;
}

void LiveOptions::check() const {
  check_capture(capture);
  require_positive("open_timeout_s", "s", open_timeout_s);
  require_positive("stall_timeout_s", "s", stall_timeout_s);
  require_positive("blind_s", "s", blind_s);
  require_positive("give_up_s", "s", give_up_s);
  require_positive("retry_s", "s", retry_s);
  require_positive("longest_retry_s", "s", longest_retry_s);
  require(longest_retry_s >= retry_s, "longest_retry_s: must not be less than retry_s (s)");
  require(queue_pictures >= 1, "queue_pictures: must be 1 or more");
}

double retry_delay_s(int attempt, const LiveOptions& options) {
  constexpr int kMostDoublings = 60;  // beyond every longest_retry_s, and no overflow
  const double wanted_s = std::ldexp(options.retry_s, std::clamp(attempt, 0, kMostDoublings));
  return std::min(wanted_s, options.longest_retry_s);
}

}  // namespace kestrel
