#include "kestrel/link/switch_log.hpp"

#include <utility>

namespace kestrel {
namespace {

bool is_power_of_ten(std::uint64_t count) {
  while (count >= 10 && count % 10 == 0) count /= 10;
  return count == 1;
}

}  // namespace

void SwitchLog::add(double stamp_s, PeerId peer, SwitchEventKind kind, std::string words) {
  if (events_.size() >= kMost) {
    ++dropped_;
    return;
  }
  events_.push_back({stamp_s, peer, kind, std::move(words)});
}

void SwitchLog::refused(double stamp_s, PeerId peer, Refused reason, std::uint64_t count) {
  if (!is_power_of_ten(count)) return;
  add(stamp_s, peer, SwitchEventKind::Refused,
      std::string(name(reason)) + " (" + std::to_string(count) + ")");
}

std::vector<SwitchEvent> SwitchLog::take() { return std::exchange(events_, {}); }

}  // namespace kestrel
