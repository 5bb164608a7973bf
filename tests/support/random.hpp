#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <string_view>

#include <Eigen/Core>

namespace kestrel::test {

/// A stream of chance of its own for each name: tests repeat and do not disturb each other.
class Random {
 public:
  explicit Random(std::string_view name) : engine_(seed(name)) {}

  /// In [low, high).
  double uniform(double low, double high) { return low + (high - low) * unit(); }
  /// Standard normal (Box-Muller).
  double normal() {
    const double u = 1 - unit();
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * M_PI * unit());
  }
  int integer(int low, int high) { return low + int(engine_() % std::uint64_t(high - low + 1)); }
  Eigen::Vector3d vector3(double size) {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  }
  /// Rotation vector of up to max_angle rad.
  Eigen::Vector3d rotation_vector(double max_angle) {
    Eigen::Vector3d axis(normal(), normal(), normal());
    return axis.normalized() * uniform(0, max_angle);
  }

 private:
  double unit() { return double(engine_() >> 11) * 0x1p-53; }
  static std::uint64_t seed(std::string_view name) {
    std::uint64_t hash = 14695981039346656037ull;  // FNV-1a
    for (const char c : name) hash = (hash ^ std::uint8_t(c)) * 1099511628211ull;
    return hash;
  }
  std::mt19937_64 engine_;
};

}  // namespace kestrel::test
