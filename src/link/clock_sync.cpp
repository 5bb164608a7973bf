#include "kestrel/link/clock_sync.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace kestrel {
namespace {

constexpr double kNanoseconds = 1e9;

std::int64_t in_ns(double seconds) { return std::llround(seconds * kNanoseconds); }

}  // namespace

void ClockSyncOptions::check() const {
  if (!(window_s > 0 && std::isfinite(window_s))) {
    throw std::invalid_argument("window_s: must be finite and positive (s)");
  }
  if (!(patience_s > 0 && std::isfinite(patience_s))) {
    throw std::invalid_argument("patience_s: must be finite and positive (s)");
  }
  if (!(drift_s_per_s >= 0 && drift_s_per_s < 1)) {
    throw std::invalid_argument("drift_s_per_s: must be from 0 to less than 1");
  }
}

ClockSync::ClockSync(const ClockSyncOptions& options) : options_(options) { options_.check(); }

mavlink::TimeSync ClockSync::ask(double now_s) {
  if (open_ns_.size() == kMaxOpen) open_ns_.pop_front();
  open_ns_.push_back(in_ns(now_s));
  return {0, open_ns_.back(), 0, 0};
}

ClockAnswer ClockSync::take(const mavlink::TimeSync& answer, double now_s) {
  const auto asked = std::find(open_ns_.begin(), open_ns_.end(), answer.ts1_ns);
  if (answer.tc1_ns == 0 || asked == open_ns_.end()) return ClockAnswer::NotAsked;
  open_ns_.erase(asked);
  const double asked_s = double(answer.ts1_ns) / kNanoseconds;
  const double round_trip_s = now_s - asked_s;
  // The question's time was rounded to a nanosecond.
  if (!(round_trip_s >= -1 / kNanoseconds) || round_trip_s > options_.patience_s) {
    return ClockAnswer::NotAsked;
  }
  const Exchange exchange{double(answer.tc1_ns) / kNanoseconds - (asked_s + now_s) / 2,
                          std::max(round_trip_s, 0.0), now_s};
  const std::optional<ClockEstimate> known = estimate(now_s);
  const double bound_s = exchange.round_trip_s / 2 + 1e-6;  // and what rounding a clock costs
  const bool jumped =
      known && std::abs(exchange.offset_s - known->offset_s) > known->error_s + bound_s;
  if (jumped) {
    exchanges_.clear();
    ++jumps_;
  }
  if (exchanges_.size() == kMaxExchanges) exchanges_.pop_front();
  exchanges_.push_back(exchange);
  return jumped ? ClockAnswer::Jumped : ClockAnswer::Used;
}

ClockEstimate ClockSync::estimate_by(const Exchange& exchange, double now_s) const {
  const double drift_s = options_.drift_s_per_s * std::max(0.0, now_s - exchange.at_s);
  return {exchange.offset_s, exchange.round_trip_s, exchange.round_trip_s / 2 + drift_s};
}

std::optional<ClockEstimate> ClockSync::estimate(double now_s) const {
  std::optional<ClockEstimate> best;
  for (const Exchange& exchange : exchanges_) {
    if (!(now_s - exchange.at_s <= options_.window_s)) continue;
    const ClockEstimate candidate = estimate_by(exchange, now_s);
    if (!best || candidate.error_s <= best->error_s) best = candidate;
  }
  return best;
}

std::optional<mavlink::TimeSync> time_answer(const mavlink::TimeSync& question,
                                             std::uint8_t system_id, std::uint8_t component_id,
                                             double now_s) {
  const bool is_question = question.tc1_ns == 0;
  const bool for_me = (question.target_system == 0 || question.target_system == system_id) &&
                      (question.target_component == 0 || question.target_component == component_id);
  if (!is_question || !for_me) return std::nullopt;
  return mavlink::TimeSync{in_ns(now_s), question.ts1_ns, 0, 0};
}

}  // namespace kestrel
