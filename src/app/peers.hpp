#pragma once

#include <algorithm>
#include <map>

#include "kestrel/link/address.hpp"

namespace kestrel::app {

/// Those who have talked to a vehicle, the last kMost of them: it talks to all.
class Peers {
 public:
  static constexpr std::size_t kMost = 16;

  void heard(const Address& peer, double now_s) {
    peers_[peer] = now_s;
    if (peers_.size() <= kMost) return;
    peers_.erase(std::min_element(peers_.begin(), peers_.end(), [](const auto& a, const auto& b) {
      return a.second < b.second;
    }));
  }

  /// Each, and when it was heard last.
  const std::map<Address, double>& all() const { return peers_; }

 private:
  std::map<Address, double> peers_;
};

}  // namespace kestrel::app
