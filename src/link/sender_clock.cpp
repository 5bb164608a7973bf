#include "kestrel/link/sender_clock.hpp"

namespace kestrel {

double stamp_difference_s(std::uint32_t a_ms, std::uint32_t b_ms) {
  return 1e-3 * double(std::int32_t(a_ms - b_ms));
}

double SenderClock::age_s(std::uint32_t time_boot_ms, double now_s) const {
  if (!shortest_) return 0;
  const double passed_s = now_s - shortest_->arrived_s;
  return passed_s * (1 - kDrift) - stamp_difference_s(time_boot_ms, shortest_->time_boot_ms);
}

void SenderClock::learn(std::uint32_t time_boot_ms, double now_s) {
  if (!shortest_ || age_s(time_boot_ms, now_s) < 0) shortest_ = Shortest{time_boot_ms, now_s};
}

}  // namespace kestrel
