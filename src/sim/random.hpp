#pragma once

#include <cmath>
#include <cstdint>

namespace kestrel::sim_detail {

/// A small stream of chance, the same on every machine: SplitMix64 (Steele, Lea & Flood 2014).
/// Neighbouring seeds give unrelated streams.
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    state_ += 0x9e3779b97f4a7c15ull;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }
  /// In [low, high).
  double uniform(double low, double high) {
    return low + (high - low) * (double(bits() >> 11) * 0x1p-53);
  }
  /// In low .. high.
  int integer(int low, int high) { return low + int(bits() % std::uint64_t(high - low + 1)); }

 private:
  std::uint64_t state_;
};

/// Seed of a stream of its own for part `index` of what `seed` stands for.
inline std::uint64_t derived_seed(std::uint64_t seed, std::uint64_t index) {
  return RandomStream(seed ^ RandomStream(index).bits()).bits();
}

/// Two independent standard normal numbers (Box-Muller): the index-th draw of a seed.
struct NormalPair {
  double first = 0;
  double second = 0;
};
inline NormalPair normal_pair(std::uint64_t seed, std::uint64_t index) {
  RandomStream stream(derived_seed(seed, index));
  const double radius = std::sqrt(-2 * std::log(1 - stream.uniform(0, 1)));
  const double angle = stream.uniform(0, 2 * M_PI);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace kestrel::sim_detail
