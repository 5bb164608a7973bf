#include "kestrel/link/frame_clock.hpp"

namespace kestrel {

void FrameClock::learn(double sent_s, double arrived_s) {
  const double ahead_s = arrived_s - sent_s;
  if (shortest_) {
    const double bound_s = shortest_->ahead_s + kDrift * (arrived_s - shortest_->learned_s);
    if (ahead_s > bound_s) return;
  }
  shortest_ = Shortest{ahead_s, arrived_s};
}

std::optional<double> FrameClock::ours(double theirs_s) const {
  if (!shortest_) return std::nullopt;
  return theirs_s + shortest_->ahead_s;
}

}  // namespace kestrel
