#include "kestrel/sim/vibration.hpp"

#include <cmath>
#include <stdexcept>

namespace kestrel {

void VibrationOptions::check() const {
  const auto require = [](bool good, const char* what) {
    if (!good) throw std::invalid_argument(what);
  };
  require(
      amplitude_rad.allFinite() && amplitude_rad.minCoeff() >= 0 && amplitude_rad.maxCoeff() < 0.1,
      "amplitude_rad: must be within [0, 0.1)");
  require(std::isfinite(frequency_hz) && frequency_hz > 0, "frequency_hz: must be positive");
  require(second_share >= 0 && second_share <= 1, "second_share: must be within [0, 1]");
}

Eigen::Vector3d vibration(const VibrationOptions& options, double time_s) {
  const double turn = 2 * M_PI * options.frequency_hz * time_s;
  Eigen::Vector3d angle;
  for (int axis = 0; axis < 3; ++axis) {
    const double phase = turn + axis * 2 * M_PI / 3;
    angle[axis] = options.amplitude_rad[axis] *
                  (std::sin(phase) + options.second_share * std::sin(2 * phase));
  }
  return angle;
}

}  // namespace kestrel
